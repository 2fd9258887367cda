//! What a pattern is written with: variables, terms, comparisons, metrics and thresholds.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AttributeId, LabelId, NodeId};
use crate::value::Value;

/// A variable of a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct Variable {
    pub(super) scope: Scope,
    pub(super) index: u16,
}

impl Variable {
    /// The position of the variable in a [`Binding`](super::Binding); `None` for a local of a negated part.
    pub fn position(self) -> Option<usize> {
        (self.scope == Scope::Top).then_some(usize::from(self.index))
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Scope {
    Top,
    Local,
}

/// A term that stands for a node.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// A variable.
    Variable(Variable),
    /// A node, by id.
    Node(NodeId),
    /// A node, by name; the name is looked up in each snapshot.
    Named(Arc<str>),
}

impl From<Variable> for Term {
    fn from(variable: Variable) -> Self {
        Self::Variable(variable)
    }
}

impl From<NodeId> for Term {
    fn from(node: NodeId) -> Self {
        Self::Node(node)
    }
}

impl From<&str> for Term {
    fn from(name: &str) -> Self {
        Self::Named(name.into())
    }
}

/// The holder of an attribute in a pattern.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum HolderTerm {
    /// A node.
    Node(Term),
    /// An edge, which must exist.
    Edge { from: Term, label: LabelId, to: Term },
}

impl HolderTerm {
    /// A node.
    pub fn node(node: impl Into<Term>) -> Self {
        Self::Node(node.into())
    }

    /// An edge.
    pub fn edge(from: impl Into<Term>, label: LabelId, to: impl Into<Term>) -> Self {
        Self::Edge { from: from.into(), label, to: to.into() }
    }
}

impl<T: Into<Term>> From<T> for HolderTerm {
    fn from(node: T) -> Self {
        Self::Node(node.into())
    }
}

/// How two values are compared. Only numbers are ordered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
}

/// The right-hand side of an attribute guard.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Operand {
    /// A constant.
    Value(Value),
    /// A node. With [`Comparison::Equal`], a variable that is not bound yet is bound to the attribute's value.
    Term(Term),
    /// Another attribute.
    Attribute(HolderTerm, AttributeId),
}

impl From<Value> for Operand {
    fn from(value: Value) -> Self {
        Self::Value(value)
    }
}

impl From<f64> for Operand {
    fn from(number: f64) -> Self {
        Self::Value(Value::Number(number))
    }
}

impl From<bool> for Operand {
    fn from(truth: bool) -> Self {
        Self::Value(Value::Bool(truth))
    }
}

impl From<Variable> for Operand {
    fn from(variable: Variable) -> Self {
        Self::Term(Term::Variable(variable))
    }
}

impl From<Term> for Operand {
    fn from(term: Term) -> Self {
        Self::Term(term)
    }
}

/// A measure between two frames, computed while matching.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Between the origins, in metres.
    Distance,
    /// The angle between the x axis of the first frame and the direction to the origin of the second, in the plane of
    /// the first, in radians. It is the same to either side.
    Bearing,
}

/// The threshold of a metric. With hysteresis there are two: the threshold to appear and the threshold to disappear, so
/// that a person at the limit does not make a match appear and disappear with each measurement. Between the two, a
/// match stays as it was, present or absent; without a history it is absent. In a negated part, the hysteresis is that
/// of the match of the whole pattern: "no person near" appears when every person has passed the second threshold, and
/// disappears when one has passed the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// A match appears when the comparison holds with this number.
    pub appears: f64,
    /// A match disappears when the comparison no longer holds with this number, which must not be stricter.
    pub disappears: f64,
}

impl From<f64> for Threshold {
    fn from(number: f64) -> Self {
        Self { appears: number, disappears: number }
    }
}

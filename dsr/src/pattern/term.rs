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
    /// The position of the variable in a [`Binding`]; `None` for a local of a negated part.
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

/// What may stand where a node is meant.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Term {
    /// A variable.
    Variable(Variable),
    /// A node, by id.
    Node(NodeId),
    /// A node, by name, looked up in each snapshot.
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

/// What carries an attribute in a pattern.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum HolderTerm {
    /// A node.
    Node(Term),
    /// An edge, which thereby must exist.
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

/// How two values are compared. Order is for numbers only.
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
    /// A node; with [`Comparison::Equal`], a variable that is not bound yet is bound to the attribute's value.
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

/// What is measured between two frames, when it is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Metric {
    /// Between the origins, in metres.
    Distance,
    /// How far the origin of the second is off the x axis of the first, in its plane and to either side, in radians.
    Bearing,
}

/// A number that a metric is held against. With hysteresis there are two, so that somebody who stands at the limit does
/// not come and go with each measurement: in the band between them a match stays what it was, there or not; without a
/// history it is not there. In a negated part this is so for the match of the pattern around it: "nobody near" appears
/// when everybody has passed the second number, and stays until somebody has passed the first.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Threshold {
    /// What is measured begins to compare so when the comparison holds with this.
    pub appears: f64,
    /// It has ceased to when the comparison no longer holds with this, which is no stricter.
    pub disappears: f64,
}

impl From<f64> for Threshold {
    fn from(number: f64) -> Self {
        Self { appears: number, disappears: number }
    }
}

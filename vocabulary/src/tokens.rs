//! The names of a vocabulary, and what each of them is in the graph.
//!
//! | PDDL | graph |
//! |---|---|
//! | type | type of nodes; below `frame`: with a pose; `agent` and `resource` are the graph's own |
//! | type below `value` (`text`, `flag`, `pose`) | a kind of attribute, without nodes |
//! | constant | a node that always exists; of type `flag`: the truth values `true` and `false` |
//! | binary predicate | label of edges |
//! | unary function | attribute of nodes |
//! | binary function | label whose edges carry one attribute of the same name; an undefined function has no edge |
//! | binary function `rt` - pose | edge of the geometric quiver, pose of the second frame in the first |
//! | binary function `distance` - number | computed by the graph from the poses |
//! | binary functions `rt_x` … `rt_yaw` - number | parts of an initial pose, in `:init` only |
//!
//! The ids of PDDL differ from domain to domain; names link them. Invariant: every id in a [`Tokens`] belongs to its
//! vocabulary.

use std::sync::Arc;

use dsr::{AttributeId, LabelId, TypeId, Value, Vocabulary};
use indexmap::IndexMap;
use pddl::model::{Domain, Name};
use rustc_hash::FxHashMap;

use crate::pose::PoseComponent;

/// What a PDDL type is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sort {
    /// A type of nodes.
    Node(TypeId),
    /// A kind of values.
    Value(ValueSort),
}

/// A kind of value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ValueSort {
    /// Text.
    Text,
    /// A truth value.
    Flag,
    /// A rigid transform.
    Pose,
}

/// What a PDDL function is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "the fields are what the variant names")]
pub enum FunctionToken {
    /// An attribute of nodes.
    Node { attribute: AttributeId },
    /// An attribute of the edges with a label of its own.
    Edge { label: LabelId, attribute: AttributeId },
    /// The pose of the second argument in the frame of the first.
    Transform,
    /// The distance between two frames.
    Distance,
    /// A number of an initial pose.
    Pose(PoseComponent),
}

/// What a constant is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Constant {
    /// An agent or a resource: the graph makes its node.
    BuiltIn(TypeId),
    /// A node of the initial graph.
    Node(TypeId),
    /// A value.
    Value(Value),
}

/// A domain of PDDL read as the vocabulary of a graph.
#[derive(Debug, Clone)]
pub struct Tokens {
    pub(crate) name: Name,
    pub(crate) vocabulary: Arc<Vocabulary>,
    pub(crate) types: FxHashMap<Name, Sort>,
    pub(crate) labels: FxHashMap<Name, LabelId>,
    pub(crate) functions: FxHashMap<Name, FunctionToken>,
    /// In the order of the source.
    pub(crate) constants: IndexMap<Name, Constant>,
    /// The domain itself: the problems of the initial graph use its ids.
    pub(crate) domain: Arc<Domain>,
}

impl Tokens {
    /// The name of the domain.
    pub fn name(&self) -> &Name {
        &self.name
    }

    /// The vocabulary for graphs.
    pub fn vocabulary(&self) -> &Arc<Vocabulary> {
        &self.vocabulary
    }

    /// What a type is, by its name.
    pub fn sort(&self, name: &str) -> Option<Sort> {
        self.types.get(name).copied()
    }

    /// The label of a predicate.
    pub fn label(&self, predicate: &str) -> Option<LabelId> {
        self.labels.get(predicate).copied()
    }

    /// What a function is.
    pub fn function(&self, name: &str) -> Option<FunctionToken> {
        self.functions.get(name).copied()
    }

    /// Whether the name is a token: the graph can store it or compute it.
    pub fn is_token(&self, name: &str) -> bool {
        self.labels.contains_key(name) || self.functions.contains_key(name)
    }

    /// The value of a constant; `None` if the constant is a node.
    pub fn value(&self, constant: &str) -> Option<&Value> {
        match self.constants.get(constant)? {
            Constant::Value(value) => Some(value),
            Constant::BuiltIn(_) | Constant::Node(_) => None,
        }
    }
}

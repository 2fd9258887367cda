//! What LowToHigh says: facts, and which of them came and went.

use std::fmt;

use pddl::model::Name;
use serde::Serialize;

/// A predicate of names that holds.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Fact {
    /// Which predicate.
    pub predicate: Name,
    /// The names of the nodes that it is about.
    pub arguments: Vec<Name>,
}

impl fmt::Display for Fact {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.predicate)?;
        for argument in &self.arguments {
            write!(f, " {argument}")?;
        }
        f.write_str(")")
    }
}

/// What a delta of the graph means for the planner's predicates. Both lists are sorted and disjoint.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub struct Change {
    /// What holds now and did not before.
    pub appeared: Vec<Fact>,
    /// What held before and does not now.
    pub disappeared: Vec<Fact>,
}

impl Change {
    /// Whether nothing came or went.
    pub fn is_empty(&self) -> bool {
        self.appeared.is_empty() && self.disappeared.is_empty()
    }
}

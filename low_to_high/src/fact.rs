//! Facts, and which of them appeared or disappeared.

use std::fmt;

use pddl::model::Name;
use serde::Serialize;

/// A ground atom of the planner, by names.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Fact {
    /// The predicate.
    pub predicate: Name,
    /// The names of its arguments, which are nodes.
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

/// A numeric fluent of the planner, by names.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct Fluent {
    /// The function.
    pub function: Name,
    /// The names of its arguments, which are nodes.
    pub arguments: Vec<Name>,
}

impl fmt::Display for Fluent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}", self.function)?;
        for argument in &self.arguments {
            write!(f, " {argument}")?;
        }
        f.write_str(")")
    }
}

/// How a delta of the graph changes what the planner knows. The lists are sorted; those of facts are disjoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Change {
    /// The facts that hold now and did not before.
    pub appeared: Vec<Fact>,
    /// The facts that held before and do not now.
    pub disappeared: Vec<Fact>,
    /// The numbers that changed, with their new values; `None`: the fluent has none.
    pub numbers: Vec<(Fluent, Option<f64>)>,
}

impl Change {
    /// Whether nothing changed.
    pub fn is_empty(&self) -> bool {
        self.appeared.is_empty() && self.disappeared.is_empty() && self.numbers.is_empty()
    }
}

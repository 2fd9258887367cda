//! Invariants: which atoms they count, and under which provisos they hold.

use pddl::model::{PredicateId, Term};

/// A predicate of an invariant.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Member {
    /// Which.
    pub predicate: PredicateId,
    /// The argument that each parameter is, by position.
    pub parameters: Vec<usize>,
    /// The argument that is counted.
    pub counted: Option<usize>,
}

impl Member {
    /// The parameters' values in an atom of the predicate.
    pub fn instance<T: Copy>(&self, arguments: &[T]) -> Vec<T> {
        self.parameters.iter().map(|&p| arguments[p]).collect()
    }
}

/// An instance of which at most one atom held initially has never more than one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Invariant {
    /// Sorted by predicate, each at most once.
    pub members: Vec<Member>,
}

impl Invariant {
    /// The member for a predicate.
    pub fn member(&self, predicate: PredicateId) -> Option<&Member> {
        self.members.iter().find(|m| m.predicate == predicate)
    }
}

/// Instances of a happening that must not be applied for an invariant to hold: those in which all of
/// these terms of its schema are equal.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Proviso {
    /// The position of the happening among all.
    pub happening: usize,
    /// Terms that differ where nothing is said; never empty.
    pub equal: Vec<(Term, Term)>,
}

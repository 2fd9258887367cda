//! Goals, and the reasons why a goal is impossible.

use super::fact::GroundAtom;
use super::literals::Literals;

/// The goal of a search.
#[derive(Clone, Debug, Default)]
pub struct Goal {
    /// The literals that must hold.
    pub literals: Literals,
    /// Set if grounding has proven that no reachable state satisfies the goal.
    pub impossible: Option<Impossible>,
}

/// The reason why a goal is impossible.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Impossible {
    /// These conjuncts are true in no reachable state.
    Atoms(Vec<GroundAtom>),
    /// These conjuncts forbid facts that hold in every reachable state.
    NegatedAtoms(Vec<GroundAtom>),
    /// These conjuncts exclude each other.
    Exclusive(Vec<GroundAtom>),
    /// A disjunction or quantified part cannot be satisfied.
    Formula,
}

impl Goal {
    /// A goal of literals.
    pub fn new(literals: Literals) -> Self {
        Self { literals, impossible: None }
    }

    pub(crate) fn holds_in(&self, words: &[u64]) -> bool {
        self.impossible.is_none() && self.literals.hold_in(words)
    }
}

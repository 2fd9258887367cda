//! The interface of every heuristic, and the costs that it counts.

use crate::ids::{OperatorId, StateId};

/// Which costs of operators a heuristic counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Costs {
    /// Each operator counts 1: the heuristic estimates the length of the plan.
    Unit,
    /// Each operator counts its cost plus 1, so no step is free.
    PlusOne,
    /// Each operator counts its cost.
    Real,
}

impl Costs {
    /// The cost that is counted for an operator of this cost.
    pub(crate) fn of(self, cost: u32) -> u32 {
        match self {
            Self::Unit => 1,
            Self::PlusOne => cost.saturating_add(1),
            Self::Real => cost,
        }
    }
}

/// An estimate; [`Estimate::DEAD_END`] means that the goal is unreachable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Estimate(pub(crate) u32);

impl Estimate {
    pub(crate) const DEAD_END: Self = Self(u32::MAX);
}

/// The input of an estimate.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'v> {
    pub(crate) id: StateId,
    pub(crate) words: &'v [u64],
    /// The operators that are applicable.
    pub(crate) applicable: &'v [OperatorId],
}

/// A heuristic for one task, one goal and a set of allowed operators.
pub(crate) trait Heuristic {
    /// Estimates a state. Appends the preferred operators among the applicable ones to `preferred`,
    /// if it is given.
    fn estimate(&mut self, view: &View<'_>, preferred: Option<&mut Vec<OperatorId>>) -> Estimate;

    /// Receives the first state, before any estimate.
    fn start(&mut self, _id: StateId, _words: &[u64]) {}

    /// Receives each step to a new or known state, before that state is estimated.
    fn step(&mut self, _from: StateId, _operator: OperatorId, _to: StateId, _words: &[u64]) {}

    /// The real cost of the plan behind the last estimate; 0 without such a plan.
    fn rest(&self) -> u64 {
        0
    }

    /// The bytes held, if they grow with the search.
    fn memory(&self) -> usize {
        0
    }
}

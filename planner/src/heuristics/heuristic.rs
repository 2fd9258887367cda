//! What every heuristic is: an estimator of states, and the costs that it counts.

use crate::ids::{OperatorId, StateId};

/// Which costs of operators a heuristic counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Costs {
    /// Each operator counts 1: estimates the length of the plan.
    Unit,
    /// Operators count what they cost and 1 more, so that no step is free.
    PlusOne,
    /// Operators count what they cost.
    Real,
}

impl Costs {
    /// What an operator of this cost counts.
    pub(crate) fn of(self, cost: u32) -> u32 {
        match self {
            Self::Unit => 1,
            Self::PlusOne => cost.saturating_add(1),
            Self::Real => cost,
        }
    }
}

/// An estimate; [`Estimate::DEAD_END`] says that the goal cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Estimate(pub(crate) u32);

impl Estimate {
    pub(crate) const DEAD_END: Self = Self(u32::MAX);
}

/// What an estimator may look at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'v> {
    pub(crate) id: StateId,
    pub(crate) words: &'v [u64],
    /// The operators that are applicable.
    pub(crate) applicable: &'v [OperatorId],
}

/// An estimator bound to a task, a goal and the operators that may be used.
pub(crate) trait Heuristic {
    /// Estimates a state. Where `preferred` is given, appends those of the applicable operators that
    /// look promising.
    fn estimate(&mut self, view: &View<'_>, preferred: Option<&mut Vec<OperatorId>>) -> Estimate;

    /// Receives the first state, before any estimate.
    fn start(&mut self, _id: StateId, _words: &[u64]) {}

    /// Receives each step of the search to a new or known state, before the estimate of that state.
    fn step(&mut self, _from: StateId, _operator: OperatorId, _to: StateId, _words: &[u64]) {}

    /// The real cost of the plan behind the last estimate; 0 without such a plan.
    fn rest(&self) -> u64 {
        0
    }

    /// Bytes held, where they grow with the search.
    fn memory(&self) -> usize {
        0
    }
}

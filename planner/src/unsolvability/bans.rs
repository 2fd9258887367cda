//! Finds the excluded operators that would otherwise be applicable.
//!
//! Problem: allowing an operator that the query excludes may not help, because its precondition may
//! never hold, either. Idea: visit the states that are reachable without the excluded operators,
//! breadth first, until each of these was applicable in one. Invariant: an operator is ruled out
//! only if all states were visited. Cost: at most [`STATES`] states and the caller's budget, once,
//! and only on the first question.

use std::ops::ControlFlow;

use super::breadth;
use super::oracle::Oracle;
use crate::ids::OperatorId;
use budget::Budget;

/// The most states that are visited: few, because an author waits for this one line of an
/// explanation.
pub(super) const STATES: u32 = 2_000;

pub(super) struct Bans {
    /// The excluded operators that were not applicable in any visited state.
    idle: Vec<OperatorId>,
    /// Whether all states were visited.
    complete: bool,
}

impl Bans {
    pub(super) fn visit(oracle: &Oracle<'_>, budget: &Budget<'_>) -> Self {
        let (task, query) = (oracle.task, &oracle.query);
        let mut idle = query.excluded.to_vec();
        let visited = breadth::visit(task, query, budget, STATES, |_, _, applicable| {
            idle.retain(|operator| !applicable.contains(operator));
            if idle.is_empty() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        Self { idle, complete: visited.complete }
    }

    /// Whether an excluded operator may be applicable in a reachable state; `false` is a proof.
    pub(super) fn may_bar(&self, operator: OperatorId) -> bool {
        !(self.complete && self.idle.contains(&operator))
    }
}

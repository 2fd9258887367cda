//! Which operators would apply, were they not excluded.
//!
//! Problem: an operator that the query excludes need not be what is missing; what it needs may never hold, either.
//! Idea: states that are reached without the excluded operators are visited, breadth first, until each of these
//! applied in one. Invariant: of an operator it is denied only if all states were visited. Cost: at most [`STATES`]
//! states and the caller's budget, once, and only on the first question.

use std::ops::ControlFlow;

use super::breadth;
use super::oracle::Oracle;
use crate::ids::OperatorId;
use budget::Budget;

/// States that are visited: few, for one line of an explanation that an author waits for.
pub(super) const STATES: u32 = 2_000;

pub(super) struct Bans {
    /// Excluded operators that did not apply in any state visited.
    idle: Vec<OperatorId>,
    /// Whether these were all states.
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

    /// Whether an excluded operator may apply in a reachable state; `false` is proven.
    pub(super) fn may_bar(&self, operator: OperatorId) -> bool {
        !(self.complete && self.idle.contains(&operator))
    }
}

//! Which operators would apply, were they not excluded.
//!
//! Problem: an operator that the query excludes need not be what is missing; what it needs may never hold, either.
//! Idea: states that are reached without the excluded operators are visited, breadth first, until each of these
//! applied in one. Invariant: of an operator it is denied only if all states were visited. Cost: at most [`STATES`] states and the caller's budget, once, and only if somebody asks.

use super::oracle::Oracle;
use crate::ids::{OperatorId, StateId};
use crate::search::{Budget, StateRegistry};

/// States that are visited: it is one line of an explanation, and somebody waits for it.
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
        let barred = query.barred(task);
        let mut bans = Self { idle: query.excluded.to_vec(), complete: true };
        let mut registry = StateRegistry::new(task, query.state.words());
        let mut here = query.state.words().to_vec();
        let mut next = here.clone();
        let (mut successors, mut visited, mut known) = (Vec::new(), 0, 1);
        registry.insert(&here, None);
        while visited < known && !bans.idle.is_empty() {
            let is_over = visited >= STATES
                || budget.expansions.is_some_and(|most| u64::from(visited) >= most)
                || budget.memory_bytes.is_some_and(|most| registry.memory() > most)
                || (budget.interrupted)();
            if is_over {
                bans.complete = false;
                break;
            }
            let id = StateId(visited);
            registry.read(id, &mut here);
            visited += 1;
            successors.clear();
            task.successors.applicable(&here, &mut successors);
            bans.idle.retain(|operator| !successors.contains(operator));
            barred.filter(&mut successors);
            for &operator in &successors {
                next.copy_from_slice(&here);
                if !task.apply(operator, &here, &mut next) {
                    // A number is too long, and what comes after it is not seen.
                    bans.complete = false;
                } else if registry.insert(&next, Some((id, operator))).1 {
                    known += 1;
                }
            }
        }
        bans
    }

    /// Whether an excluded operator may apply in a reachable state; `false` is proven.
    pub(super) fn may_bar(&self, operator: OperatorId) -> bool {
        !(self.complete && self.idle.contains(&operator))
    }
}

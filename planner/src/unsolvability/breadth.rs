//! Visits all reachable states, breadth first, within the caller's budget.
//!
//! Invariant: `complete` only if every state that is reachable without the excluded operators was
//! visited. The first state is always visited. Cost: the states and operators visited.

use std::ops::ControlFlow;

use crate::ids::{OperatorId, StateId};
use crate::search::{Query, StateRegistry};
use crate::task::Task;
use budget::Budget;

/// The result of a visit.
pub(super) struct Visited<'t> {
    pub(super) registry: StateRegistry<'t>,
    /// The number of states visited.
    pub(super) states: u32,
    /// Whether all reachable states were visited.
    pub(super) complete: bool,
}

/// Visits at most `most` states, until `look` breaks. `look` gets a state and all operators that
/// are applicable in it, including excluded ones.
pub(super) fn visit<'t>(
    task: &'t Task,
    query: &Query<'_>,
    budget: &Budget<'_>,
    most: u32,
    mut look: impl FnMut(StateId, &[u64], &[OperatorId]) -> ControlFlow<()>,
) -> Visited<'t> {
    let barred = query.barred(task);
    let mut registry = StateRegistry::new(task, query.state.words());
    let mut here = query.state.words().to_vec();
    let mut next = here.clone();
    let (mut successors, mut visited, mut known) = (Vec::new(), 0, 1);
    registry.insert(&here, None);
    let mut complete = true;
    while visited < known {
        let asks = visited % 256 == 0;
        let is_over = visited >= most
            || budget.work.is_some_and(|most| u64::from(visited) >= most)
            || (asks && (budget.interrupted)())
            || (asks && budget.memory_bytes.is_some_and(|most| registry.memory() > most));
        if visited > 0 && is_over {
            complete = false;
            break;
        }
        let id = StateId(visited);
        registry.read(id, &mut here);
        visited += 1;
        successors.clear();
        task.successors.applicable(&here, &mut successors);
        if look(id, &here, &successors).is_break() {
            complete = false;
            break;
        }
        barred.filter(&mut successors);
        for &operator in &successors {
            next.copy_from_slice(&here);
            if !task.apply(operator, &here, &mut next) {
                // A number does not fit, so the states behind this operator are not visited.
                complete = false;
            } else if registry.insert(&next, Some((id, operator))).1 {
                known += 1;
            }
        }
    }
    Visited { registry, states: visited, complete }
}

//! Action elimination: removes steps that a plan does not need.
//!
//! Idea: leave out one step, and every later step that is therefore inapplicable. If the goal still
//! holds at the end, the plan does not need these steps. Invariant: the result reaches the goal and
//! costs no more. Cost: quadratic in the length of the plan, so very long plans are returned
//! unchanged.
//!
//! Source: Nakhost & Müller, "Action elimination and plan neighborhood graph search", ICAPS 2010.

use super::{Plan, Query};
use crate::ids::OperatorId;
use crate::task::Task;

/// The most words that are copied.
const WORK: usize = 1 << 23;

/// Returns the plan without needless steps. Stops early if the caller interrupts.
pub(crate) fn without_needless(
    task: &Task,
    query: &Query<'_>,
    plan: &Plan,
    interrupted: &dyn Fn() -> bool,
) -> Plan {
    let n = plan.operators.len();
    if n * n * (task.words_per_state() + 8) / 2 > WORK {
        return plan.clone();
    }
    let mut kept = plan.operators.clone();
    let mut state = query.state.words().to_vec();
    let mut next = state.clone();
    let mut i = 0;
    while i < kept.len() && !interrupted() {
        if let Some(shorter) = left_out(task, query, &state, &kept[i..]) {
            kept.truncate(i);
            kept.extend(shorter);
            continue;
        }
        next.copy_from_slice(&state);
        if !task.apply(kept[i], &state, &mut next) {
            return plan.clone();
        }
        std::mem::swap(&mut state, &mut next);
        i += 1;
    }
    let shorter = Plan::of(task, kept);
    // A step that the goal does not need may still improve the metric.
    let measure = |plan: &Plan| task.quality(query.state, &plan.operators);
    match (measure(plan), measure(&shorter)) {
        (Some(whole), Some(less)) if whole.is_below(less) => plan.clone(),
        _ => shorter,
    }
}

/// What is left to do of steps that were planned for other goals: those that can be applied and that the goal of the query
/// needs; `None` if they do not reach it.
pub fn still_needed(
    task: &Task,
    query: &Query<'_>,
    steps: &[OperatorId],
    interrupted: &dyn Fn() -> bool,
) -> Option<Plan> {
    let mut state = query.state.clone();
    let mut kept = Vec::new();
    for &operator in steps.iter().filter(|operator| !query.excluded.contains(operator)) {
        if let Some(next) = task.successor(&state, operator) {
            state = next;
            kept.push(operator);
        }
    }
    let reaches = task.satisfies(&state, query.goal);
    reaches.then(|| without_needless(task, query, &Plan::of(task, kept), interrupted))
}

/// Returns the steps after the first that are applicable without it, if they reach the goal.
fn left_out(task: &Task, query: &Query<'_>, from: &[u64], steps: &[OperatorId]) -> Option<Vec<OperatorId>> {
    let mut state = from.to_vec();
    let mut next = state.clone();
    let mut done = Vec::new();
    for &operator in &steps[1..] {
        if task.operator(operator).precondition.hold_in(&state) {
            next.copy_from_slice(&state);
            if !task.apply(operator, &state, &mut next) {
                return None;
            }
            std::mem::swap(&mut state, &mut next);
            done.push(operator);
        }
    }
    query.goal.holds_in(&state).then_some(done)
}

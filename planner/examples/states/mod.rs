//! What the examples that replan start from.

use planner::{Plan, State, Task};

/// The states along a plan from the initial one, both ends included.
pub(crate) fn along(task: &Task, plan: &Plan) -> Result<Vec<State>, &'static str> {
    let mut states = vec![task.initial_state().clone()];
    for step in &plan.operators {
        let next = states.last().and_then(|last| task.successor(last, *step));
        states.push(next.ok_or("the plan cannot be carried out")?);
    }
    Ok(states)
}

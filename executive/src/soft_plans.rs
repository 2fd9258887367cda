//! Plans that go for soft goals as far as they are worth it.
//!
//! Problem: which soft goals a plan should reach depends on what each adds to its cost. Idea: the part of the mission from
//! the sensed state is compiled (`goal/soft.rs`), grounded and solved for the lowest cost, in the thread that decides; the
//! steps are then those of the mission's own task again. This happens once for each set of soft goals: from then on, those
//! that the plan collects are pursued like hard ones, and the others are given up.
//!
//! Source: Keyder & Geffner, "Soft goals can be compiled away", JAIR 2009.

use crate::goal::{Compilation, GoalId, compile_soft};
use crate::{Model, Step};
use planner::{
    Budget, GroundOptions, OperatorId, Outcome, Query, SearchConfiguration, State, Task, ground, improve,
};

/// A plan, and the soft goals that it reaches.
pub(crate) struct SoftPlan {
    pub(crate) operators: Vec<OperatorId>,
    pub(crate) collected: Vec<GoalId>,
}

/// The cheapest plan from `state` for the hard goals, with what it does not reach of the soft ones as a part of its cost;
/// `None` if the budget does not allow one.
pub(crate) fn soft_plan(
    model: &Model,
    state: &State,
    hard: &[GoalId],
    soft: &[GoalId],
    barred: &[Step],
    budget: &Budget<'_>,
) -> Option<SoftPlan> {
    let priced: Vec<_> = soft.iter().map(|&goal| model.soft(goal)).collect::<Option<_>>()?;
    let problem = model.problem_in(state, hard);
    let Compilation { domain, problem, first, collects } = compile_soft(model.domain(), &problem, &priced);
    let within = Budget { interrupted: budget.interrupted, ..Budget::default() };
    let task =
        ground(&domain, &problem, &GroundOptions { budget: within, ..GroundOptions::default() }).ok()?;
    let is_barred = |operator: OperatorId| {
        let operator = task.operator(operator);
        let name = |&object: &pddl::model::ObjectId| problem.objects[object].name.clone();
        let action = domain.actions[operator.action].name.clone();
        barred.contains(&Step { action, arguments: operator.arguments.iter().map(name).collect() })
    };
    let excluded: Vec<_> = match barred.is_empty() {
        true => Vec::new(),
        false => task.operators().ids().filter(|&operator| is_barred(operator)).collect(),
    };
    let query = Query { excluded: &excluded, ..Query::of(&task) };
    let report = improve(&task, &query, &SearchConfiguration::default(), budget, &mut |_| ()).report;
    let Outcome::Solved(plan) = report.outcome else { return None };
    let actions: Vec<_> = plan.operators.iter().map(|&operator| task.operator(operator).action).collect();
    let collected = soft.iter().zip(&collects).filter(|(_, collect)| actions.contains(collect));
    let own = plan.operators.iter().filter(|&&operator| task.operator(operator).action < first);
    let operators = own_steps(model.task(), state, &task, own)?;
    Some(SoftPlan { operators, collected: collected.map(|(&goal, _)| goal).collect() })
}

/// The same steps as operators of the mission's task.
fn own_steps<'o>(
    task: &Task,
    state: &State,
    other: &Task,
    steps: impl Iterator<Item = &'o OperatorId>,
) -> Option<Vec<OperatorId>> {
    let mut state = state.clone();
    let mut found = Vec::new();
    for &step in steps {
        let step = other.operator(step);
        let same = |&operator: &OperatorId| {
            let own = task.operator(operator);
            own.action == step.action && own.arguments == step.arguments
        };
        let next = |operator: OperatorId| Some((operator, task.successor(&state, operator)?));
        let (operator, after) = task.operators().ids().filter(same).find_map(next)?;
        found.push(operator);
        state = after;
    }
    Some(found)
}

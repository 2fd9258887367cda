//! A goal that no plan reaches.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unreachable-goal",
    level: Level::Default,
    explanation: explanation!("W0855"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let objects = &view.problem.objects;
    for goal in &view.analysis().never.goals {
        let span = goal.condition.span;
        let with: Vec<String> = goal
            .values
            .iter()
            .map(|&(v, o)| format!("`?{}` = `{}`", view.problem.goal_variables[v].name, objects[o].name))
            .collect();
        let with = if with.is_empty() { String::new() } else { format!(" for {}", with.join(", ")) };
        let message = format!("the goal can never be reached{with}: {}", goal.reason);
        found.report(LINT.finding(place::problem(span), message));
    }
}

//! A subtask of the problem's network that no method can carry out.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "impossible-task",
    level: Level::Default,
    explanation: explanation!("W0854"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let Some((_, network)) = &view.problem.htn else { return };
    for subtask in &view.analysis().never.impossible {
        let Some(task) = network.subtasks.get(subtask.subtask) else { continue };
        let message = format!("this task can never be carried out: {}", subtask.reason);
        found.report(LINT.finding(place::problem(task.span), message));
    }
}

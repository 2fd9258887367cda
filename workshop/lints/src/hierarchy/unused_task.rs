//! A compound task that is never used.

use pddl::model::SubtaskHead;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-task",
    level: Level::Default,
    explanation: explanation!("W0902"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let domain = view.domain.domain;
    if !view.is_complete() || view.problem.htn.is_none() {
        return;
    }
    for (id, task) in domain.tasks.enumerate() {
        let others = domain.methods.iter().filter(|method| method.task != id);
        let mut subtasks = others.flat_map(|method| &method.network.subtasks);
        if !view.usage().tasks[id] && !subtasks.any(|subtask| subtask.head == SubtaskHead::Task(id)) {
            let message = format!("nothing asks for the task `{}`", task.name);
            found.report(LINT.finding(place::domain(task.span), message));
        }
    }
}

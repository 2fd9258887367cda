//! A compound task that nothing can carry out.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "task-without-method",
    level: Level::Default,
    explanation: explanation!("W0901"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for (id, task) in view.domain.tasks.enumerate() {
        if view.domain.methods.iter().all(|method| method.task != id) {
            let message = format!("no method is for the task `{}`", task.name);
            found.report(LINT.finding(place::domain(task.span), message));
        }
    }
}

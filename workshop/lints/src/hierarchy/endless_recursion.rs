//! A task whose methods all lead to a task of that kind.

use pddl::model::{Idx, Method, SubtaskHead};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "endless-recursion",
    level: Level::Default,
    explanation: explanation!("W0903"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let domain = view.domain;
    // What has no method at all is another mistake, and must not make others look endless.
    let mut ends: Vec<bool> =
        domain.tasks.ids().map(|id| domain.methods.iter().all(|method| method.task != id)).collect();
    loop {
        let ready = |method: &&Method| {
            !ends[method.task.index()]
                && method.network.subtasks.iter().all(|subtask| match subtask.head {
                    SubtaskHead::Task(task) => ends[task.index()],
                    SubtaskHead::Action(_) | SubtaskHead::DurativeAction(_) => true,
                })
        };
        match domain.methods.iter().find(ready).map(|method| method.task.index()) {
            Some(task) => ends[task] = true,
            None => break,
        }
    }
    for (_, task) in domain.tasks.enumerate().filter(|(id, _)| !ends[id.index()]) {
        let message = format!(
            "every method for the task `{}` leads to a task like it again, without an end",
            task.name
        );
        found.report(LINT.finding(place::domain(task.span), message));
    }
}

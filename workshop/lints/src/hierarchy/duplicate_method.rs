//! Two methods that say the same.

use pddl::Span;
use pddl::model::{Name, TaskId};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place, shape};

pub(crate) static LINT: Lint = Lint {
    name: "duplicate-method",
    level: Level::Default,
    explanation: explanation!("W0906"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let mut first: FxHashMap<(TaskId, String), (&Name, Span)> = FxHashMap::default();
    for method in &view.domain.methods {
        let shape = shape::schema(&method.variables, |shape| {
            shape.terms(&method.task_arguments)
                + &shape.condition(&method.precondition)
                + &shape.network(&method.network)
        });
        if let Some((other, earlier)) = first.get(&(method.task, shape.clone())) {
            let message = format!("method `{}` says the same as `{other}`", method.name);
            let finding = LINT.finding(place::domain(method.span), message);
            found.report(finding.label(place::domain(*earlier), "the other one"));
        } else {
            first.insert((method.task, shape), (&method.name, method.span));
        }
    }
}

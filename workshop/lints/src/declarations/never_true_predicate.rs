//! A predicate that conditions need and nothing makes true.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "never-true-predicate",
    level: Level::Default,
    explanation: explanation!("W0705"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let (domain, initial) = (view.domain.usage(), view.usage());
    for (id, predicate) in view.domain.domain.predicates.enumerate() {
        let used = domain.predicates[id];
        let needed = used.needed_true || initial.predicates[id].needed_true;
        if is_here(predicate.span) && needed && !used.produced() && !initial.predicates[id].added {
            let message = format!(
                "conditions need `{}`, but no effect makes it true and it never holds initially",
                predicate.name
            );
            found.report(LINT.finding(place::domain(predicate.span), message));
        }
    }
}

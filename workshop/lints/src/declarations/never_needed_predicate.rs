//! A predicate that effects change and nothing asks for.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "never-needed-predicate",
    level: Level::Pedantic,
    explanation: explanation!("W0704"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    // Where tasks are the goal, effects may be meant for the executive of the plan.
    if !view.is_complete() || !view.domain.domain.tasks.is_empty() {
        return;
    }
    let (domain, asked) = (view.domain.usage(), view.usage());
    for (id, predicate) in view.domain.domain.predicates.enumerate() {
        let used = domain.predicates[id];
        if is_here(predicate.span) && used.fluent() && !used.needed() && !asked.predicates[id].needed() {
            let message =
                format!("effects change `{}`, but no condition and no goal asks for it", predicate.name);
            found.report(LINT.finding(place::domain(predicate.span), message));
        }
    }
}

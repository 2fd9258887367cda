//! A predicate that is never used.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-predicate",
    level: Level::Default,
    explanation: explanation!("W0703"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() || view.is_vocabulary() {
        return;
    }
    let usage = view.usage();
    for (id, predicate) in view.domain.predicates.enumerate() {
        let used = usage.predicates[id];
        if is_here(predicate.span) && !used.needed() && !used.fluent() {
            let message = format!("nothing in this domain names the predicate `{}`", predicate.name);
            found.report(LINT.finding(place::domain(predicate.span), message));
        }
    }
}

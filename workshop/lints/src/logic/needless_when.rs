//! `when` with a condition that always holds.

use super::changes::Changes;
use super::literals::{Literal, conjuncts, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "needless-when",
    level: Level::Default,
    explanation: explanation!("W0807"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for action in &view.domain.actions {
        let asked = required([&action.precondition]);
        for when in &Changes::of([&action.effect]).whens {
            let mut parts = Vec::new();
            conjuncts(when.condition, &mut parts);
            let holds = |literal: Literal| asked.iter().any(|a| a.repeats(&literal));
            if parts.into_iter().all(|part| Literal::of(part).is_some_and(holds)) {
                let message = "this condition always holds here: the precondition asks for it";
                let span = when.condition.span;
                let place = place::domain(if span.start < span.end { span } else { when.whole.span });
                found.report(LINT.finding(place, message).help("write the effect without `when`"));
            }
        }
    }
}

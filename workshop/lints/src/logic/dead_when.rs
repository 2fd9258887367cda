//! `when` with a condition that the precondition rules out.

use super::changes::Changes;
use super::literals::required;
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "dead-when",
    level: Level::Default,
    explanation: explanation!("W0808"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    for action in &view.domain.actions {
        let asked = required([&action.precondition]);
        for when in &Changes::of([&action.effect]).whens {
            for literal in required([when.condition]) {
                if let Some(other) = asked.iter().find(|a| a.contradicts(&literal)) {
                    let message = "this never holds here, so that the effect never happens";
                    let finding = LINT.finding(place::domain(literal.span), message);
                    found.report(finding.label(place::domain(other.span), "the precondition asks for this"));
                }
            }
        }
    }
}

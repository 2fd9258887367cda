//! A constant that is never used.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-constant",
    level: Level::Default,
    explanation: explanation!("W0708"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.domain.is_vocabulary() {
        return;
    }
    for (id, constant) in view.domain.domain.constants.enumerate() {
        if is_here(constant.span) && !view.domain.usage().names(id) && !view.usage().names(id) {
            let message = format!("nothing names the constant `{}`", constant.name);
            found.report(LINT.finding(place::domain(constant.span), message));
        }
    }
}

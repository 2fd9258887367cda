//! A goal that holds initially.

use super::static_goal::true_initially;
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "goal-already-true",
    level: Level::Pedantic,
    explanation: explanation!("W0813"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    for (literal, predicate) in true_initially(view) {
        if view.domain.usage().predicates[predicate].fluent() {
            found.report(LINT.finding(place::problem(literal.span), "this holds already"));
        }
    }
}

//! An object that the problem only declares.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-object",
    level: Level::Pedantic,
    explanation: explanation!("W0715"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let (constants, usage) = (view.domain.domain.constants.len(), view.usage());
    for (id, object) in view.problem.objects.enumerate().skip(constants) {
        if !usage.names(id) {
            let message = format!("nothing in this problem is about `{}`", object.name);
            found.report(LINT.finding(place::problem(object.span), message));
        }
    }
}

//! A function that is never used.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-function",
    level: Level::Default,
    explanation: explanation!("W0706"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.domain.is_vocabulary() {
        return;
    }
    let (domain, problem) = (view.domain.usage(), view.usage());
    for (id, function) in view.domain.domain.functions.enumerate() {
        let used = domain.functions[id];
        if is_here(function.span) && !used.read && !used.written && !problem.functions[id].read {
            let message = format!("nothing asks for the function `{}` or changes it", function.name);
            found.report(LINT.finding(place::domain(function.span), message));
        }
    }
}

//! A function that effects change and nothing asks for.

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "never-read-function",
    level: Level::Pedantic,
    explanation: explanation!("W0718"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let (domain, problem) = (view.domain.usage(), view.usage());
    for (id, function) in view.domain.domain.functions.enumerate() {
        let used = domain.functions[id];
        let read = used.read || problem.functions[id].read || &*function.name == "total-cost";
        if is_here(function.span) && used.written && !read {
            let message = format!("effects change `{}`, but nothing asks for its value", function.name);
            found.report(LINT.finding(place::domain(function.span), message));
        }
    }
}

//! A function that is read and never has a value.

use pddl::model::{AssignOperator, IndexVec};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{ProblemView, is_here};
use crate::{Level, Lint, place};
use analysis::walk::Part;

pub(crate) static LINT: Lint = Lint {
    name: "uninitialised-function",
    level: Level::Default,
    explanation: explanation!("W0816"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let domain = view.domain.domain;
    if !view.is_complete() || domain.functions.is_empty() {
        return;
    }
    let mut needed: IndexVec<_, bool> = vec![false; domain.functions.len()].into();
    let mut assigned = needed.clone();
    for schema in view.domain.schemas() {
        schema.parts(&mut |part| match part {
            Part::Reads(application) => needed[application.function] = true,
            Part::Writes(AssignOperator::Assign, application) => assigned[application.function] = true,
            // An increase reads the present value.
            Part::Writes(_, application) => needed[application.function] = true,
            _ => {}
        });
    }
    for (id, function) in domain.functions.enumerate().filter(|(_, f)| is_here(f.span)) {
        if needed[id] && !assigned[id] && !view.usage().functions[id].written {
            let message = format!("actions need the value of `{}`, but nothing gives it one", function.name);
            found.report(LINT.finding(place::domain(function.span), message));
        }
    }
}

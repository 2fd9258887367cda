//! `:parameters (?x ?y)` where nothing says `?y`.

use pddl::model::{Idx, Term};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-parameter",
    level: Level::Default,
    explanation: explanation!("W0709"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    for schema in view.schemas() {
        let variables = schema.variables();
        let mut used = vec![false; variables.slots.len()];
        schema.parts(&mut |part| {
            for term in part.terms() {
                if let Term::Variable(variable) = term {
                    used[variable.index()] = true;
                }
            }
        });
        for id in variables.parameter_ids().filter(|id| !used[id.index()]) {
            let variable = &variables[id];
            let message =
                format!("{} does not use its parameter `?{}`", schema.title(view.domain), variable.name);
            found.report(LINT.finding(place::domain(variable.span), message));
        }
    }
}

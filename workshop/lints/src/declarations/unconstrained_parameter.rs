//! A parameter that may be anything.

use pddl::model::{Domain, Idx, Term, TypeTable};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::schema::Schema;
use crate::view::DomainView;
use crate::{Level, Lint, place};
use analysis::walk::Part;

pub(crate) static LINT: Lint = Lint {
    name: "unconstrained-parameter",
    level: Level::Default,
    explanation: explanation!("W0711"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    if !view.is_complete() || !tells_objects_apart(view) {
        return;
    }
    let actions =
        view.schemas().filter(|s| matches!(s, Schema::Action(_) | Schema::Durative(_) | Schema::Event(_)));
    for schema in actions {
        let variables = schema.variables();
        let (mut asked, mut changed) =
            (vec![false; variables.slots.len()], vec![false; variables.slots.len()]);
        schema.parts(&mut |part| {
            let marks = match part {
                Part::Adds(_) | Part::Deletes(_) | Part::Writes(..) => &mut changed,
                _ => &mut asked,
            };
            for term in part.terms() {
                if let Term::Variable(variable) = term {
                    marks[variable.index()] = true;
                }
            }
        });
        for id in variables.parameter_ids().filter(|id| changed[id.index()] && !asked[id.index()]) {
            let variable = &variables[id];
            if variable.types.0.contains(&TypeTable::OBJECT) {
                let title = schema.title(view.domain);
                let message =
                    format!("the parameter `?{}` of {title} may be any object at all", variable.name);
                let help = "name it in a condition, or give it a type";
                found.report(LINT.finding(place::domain(variable.span), message).help(help));
            }
        }
    }
}

/// Whether there are types, or predicates of one argument that nothing changes and conditions ask for.
fn tells_objects_apart(view: &DomainView<'_>) -> bool {
    let Domain { types, predicates, .. } = view.domain;
    types.len() > 1
        || predicates.enumerate().any(|(id, predicate)| {
            let used = view.usage().predicates[id];
            predicate.variables.parameters == 1 && used.needed_true && !used.fluent()
        })
}

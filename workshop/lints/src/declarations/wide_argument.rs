//! A variable of a wider type than what it is an argument of.

use pddl::model::{Domain, Name, Term, Variables};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};
use analysis::walk::Part;

pub(crate) static LINT: Lint = Lint {
    name: "wide-argument",
    level: Level::Default,
    explanation: explanation!("W0716"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let domain = view.domain;
    for schema in view.schemas() {
        let variables = schema.variables();
        schema.parts(&mut |part| {
            let (name, parameters, span): (&Name, &Variables, _) = match part {
                Part::Needs(atom, _) | Part::Adds(atom) | Part::Deletes(atom) => {
                    let predicate = &domain.predicates[atom.predicate];
                    (&predicate.name, &predicate.variables, atom.span)
                }
                Part::Reads(application) | Part::Writes(_, application) => {
                    let function = &domain.functions[application.function];
                    (&function.name, &function.variables, application.span)
                }
                _ => return,
            };
            for (term, parameter) in part.terms().iter().zip(parameters.parameters()) {
                let Term::Variable(variable) = *term else { continue };
                let given = &variables[variable];
                if !domain.types.is_subset(&given.types, &parameter.types) {
                    let (of, needed) = (type_text(domain, &given.types), type_text(domain, &parameter.types));
                    let message =
                        format!("`?{}` is of type {of}, but `{name}` is about {needed} only", given.name);
                    let finding = LINT.finding(place::domain(span), message);
                    found.report(finding.label(place::domain(given.span), "declared here"));
                }
            }
        });
    }
}

/// `truck`, or `(either truck plane)`, in quotes.
pub(crate) fn type_text(domain: &Domain, types: &pddl::model::TypeSet) -> String {
    match types.0.as_slice() {
        [one] => format!("`{}`", domain.types[*one].name),
        many => {
            let names: Vec<&str> = many.iter().map(|&t| domain.types[t].name.as_str()).collect();
            format!("`(either {})`", names.join(" "))
        }
    }
}

//! A variable of a wider type than what its subtask takes.

use pddl::model::{SubtaskHead, Term, Variables};

use crate::declarations::type_text;
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::DomainView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "wide-subtask",
    level: Level::Default,
    explanation: explanation!("W0905"),
    checks: &[Check::Domain(check)],
};

fn check(view: &DomainView<'_>, found: &mut Findings) {
    let domain = view.domain;
    for method in &domain.methods {
        for subtask in &method.network.subtasks {
            let (name, parameters): (_, &Variables) = match subtask.head {
                SubtaskHead::Task(id) => (&domain.tasks[id].name, &domain.tasks[id].variables),
                SubtaskHead::Action(id) => (&domain.actions[id].name, &domain.actions[id].variables),
                SubtaskHead::DurativeAction(id) => {
                    let action = &domain.durative_actions[id];
                    (&action.name, &action.variables)
                }
            };
            for (term, parameter) in subtask.arguments.iter().zip(parameters.parameters()) {
                let Term::Variable(variable) = *term else { continue };
                let given = &method.variables[variable];
                if !domain.types.is_subset(&given.types, &parameter.types) {
                    let (of, takes) = (type_text(domain, &given.types), type_text(domain, &parameter.types));
                    let message =
                        format!("`?{}` is of type {of}, but `{name}` takes {takes} only", given.name);
                    let finding = LINT.finding(place::domain(subtask.span), message);
                    found.report(finding.label(place::domain(given.span), "declared here"));
                }
            }
        }
    }
}

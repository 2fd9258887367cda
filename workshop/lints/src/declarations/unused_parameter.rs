//! `:parameters (?x ?y)` where nothing says `?y`.

use pddl::Explanation;
use pddl::model::{Idx, Term};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::DomainView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-parameter",
    level: Level::Default,
    explanation: Explanation {
        code: "W0709",
        title: "unused parameter",
        meaning: "No condition, effect or subtask of an action, a rule or a method names this parameter.",
        why: "It changes nothing, and yet there is an instance for each object that it may stand for: a planner \
         grounds and searches many times the same. Either a condition is missing that should tell which object \
         is meant, or the parameter can go.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp room)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp ?y - room)
    :effect (lit ?x)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))"],
    },
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
            found.report(Finding::new(&LINT, Place::domain(variable.span), message));
        }
    }
}

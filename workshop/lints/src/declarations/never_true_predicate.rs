//! A predicate that conditions need and nothing makes true.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{ProblemView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "never-true-predicate",
    level: Level::Default,
    explanation: Explanation {
        code: "W0705",
        title: "predicate is never true",
        meaning: "A condition needs a predicate to be true, but no effect and no axiom makes it true, and it does \
         not hold initially in any of the problems that were looked at.",
        why: "The condition can never hold: an action that needs it is dead. Either an effect is missing, or \
         `:init` lacks facts, or two predicates mean the same and one of them is used in effects, the \
         other one in conditions.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (plugged ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (plugged ?x)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (lit left)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (plugged ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (plugged ?x)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (plugged left))
  (:goal (lit left)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let (domain, initial) = (view.domain.usage(), view.usage());
    for (id, predicate) in view.domain.domain.predicates.enumerate() {
        let used = domain.predicates[id];
        let needed = used.needed_true || initial.predicates[id].needed_true;
        if is_here(predicate.span) && needed && !used.produced() && !initial.predicates[id].added {
            let message = format!(
                "conditions need `{}`, but no effect makes it true and it never holds initially",
                predicate.name
            );
            found.report(Finding::new(&LINT, Place::domain(predicate.span), message));
        }
    }
}

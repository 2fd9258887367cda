//! A predicate that effects change and nothing asks for.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{ProblemView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "never-needed-predicate",
    level: Level::Pedantic,
    explanation: Explanation {
        code: "W0704",
        title: "predicate is never needed",
        meaning: "Effects or axioms make a predicate true or false, but no condition of the domain asks for it, \
         and no goal or constraint of the problems that were looked at. Hierarchical domains are not looked at.",
        why: "It changes nothing that can be done, unless other problems have it in their goals. Often a condition is missing: the effect `(occupied \
         ?place)` is of no use while no action needs `(not (occupied ?place))`.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (warm ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (warm ?x))))",
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
  (:requirements :typing :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (warm ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (warm ?x)))
  (:action change
    :parameters (?x - lamp)
    :precondition (not (warm ?x))
    :effect (not (lit ?x))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (lit left)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    // Where tasks are the goal, effects may be there to be seen by whoever runs the plan.
    if !view.is_complete() || !view.domain.domain.tasks.is_empty() {
        return;
    }
    let (domain, asked) = (view.domain.usage(), view.usage());
    for (id, predicate) in view.domain.domain.predicates.enumerate() {
        let used = domain.predicates[id];
        if is_here(predicate.span) && used.fluent() && !used.needed() && !asked.predicates[id].needed() {
            let message =
                format!("effects change `{}`, but no condition and no goal asks for it", predicate.name);
            found.report(Finding::new(&LINT, Place::domain(predicate.span), message));
        }
    }
}

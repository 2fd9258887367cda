//! A goal that holds initially.

use pddl::Explanation;

use super::static_goal::true_initially;
use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "goal-already-true",
    level: Level::Pedantic,
    explanation: Explanation {
        code: "W0813",
        title: "goal holds initially",
        meaning: "A part of the goal holds in the initial state.",
        why: "Often that is meant: it may have to be given up on the way and reached again. Sometimes the \
         wrong facts were copied.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (lit ?x))
    :effect (and (lit ?x) (broken ?x))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (broken left))
  (:goal (and (lit left) (broken left))))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (not (lit ?x))
    :effect (and (lit ?x) (broken ?x))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (and (lit left) (broken left))))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    for (literal, predicate) in true_initially(view) {
        if view.domain.usage().predicates[predicate].fluent() {
            found.report(Finding::new(&LINT, Place::problem(literal.span), "this holds already"));
        }
    }
}

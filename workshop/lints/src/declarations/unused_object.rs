//! An object that the problem only declares.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-object",
    level: Level::Pedantic,
    explanation: Explanation {
        code: "W0715",
        title: "unused object",
        meaning: "An object is declared, but no fact, goal or task of its problem names it.",
        why: "No action that needs a fact about it can ever use it. Often its facts were forgotten; otherwise \
         it makes grounding larger for nothing.",
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
  (:objects left right - lamp)
  (:init (plugged left))
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
    let (constants, usage) = (view.domain.domain.constants.len(), view.usage());
    for (id, object) in view.problem.objects.enumerate().skip(constants) {
        if !usage.names(id) {
            let message = format!("nothing in this problem is about `{}`", object.name);
            found.report(Finding::new(&LINT, Place::problem(object.span), message));
        }
    }
}

//! A `when` whose condition never holds when its action applies.

use pddl::Explanation;

use crate::lint::Check;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-conditional-effect",
    level: Level::Default,
    explanation: Explanation {
        code: "W0852",
        title: "conditional effect never happens",
        meaning: "An action can apply, but never with the condition of this `when`.",
        why: "The effect is dead text: its condition contradicts the action's own, or needs what nothing makes \
         true.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :conditional-effects :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (hot ?l - lamp) (warm ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (and (lit ?l) (when (hot ?l) (warm ?l))))
  (:action cool
    :parameters (?l - lamp)
    :precondition (warm ?l)
    :effect (and (not (lit ?l)) (not (warm ?l)) (hot ?l))))",
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
  (:requirements :typing :conditional-effects :negative-preconditions)
  (:types lamp)
  (:predicates (lit ?l - lamp) (warm ?l - lamp))
  (:action switch
    :parameters (?l - lamp)
    :effect (and (lit ?l) (when (lit ?l) (warm ?l))))
  (:action cool
    :parameters (?l - lamp)
    :precondition (warm ?l)
    :effect (and (not (lit ?l)) (not (warm ?l)))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init)
  (:goal (lit left)))",
        ],
    },
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording = Wording { lint: &LINT, about: |o| o.when.is_some(), verdict: "never happens" };

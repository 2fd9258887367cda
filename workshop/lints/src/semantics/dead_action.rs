//! An action that no plan of any problem can contain.

use pddl::Explanation;

use crate::lint::Check;
use crate::reachability::Schema;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-action",
    level: Level::Default,
    explanation: Explanation {
        code: "W0850",
        title: "action can never apply",
        meaning: "Even if nothing that was made true ever became false again, the action's condition would hold in \
         no state of any problem that was looked at. What only follows from this is named with it. Not said where \
         the reason is nothing but objects and facts that the problem lacks.",
        why: "It is dead text, and usually something else is wrong: an effect that is missing or has its \
         arguments the other way round, two conditions that exclude each other, or two actions that wait for \
         each other. The message follows what is needed to its root.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types door)
  (:predicates (open ?d - door) (unlocked ?d - door) (key))
  (:action unlock
    :parameters (?d - door)
    :precondition (and (key) (open ?d))
    :effect (unlocked ?d))
  (:action push
    :parameters (?d - door)
    :precondition (unlocked ?d)
    :effect (open ?d))
  (:action take
    :effect (key)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects front back - door)
  (:init)
  (:goal (key)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types door)
  (:predicates (open ?d - door) (unlocked ?d - door) (key))
  (:action unlock
    :parameters (?d - door)
    :precondition (key)
    :effect (unlocked ?d))
  (:action push
    :parameters (?d - door)
    :precondition (unlocked ?d)
    :effect (open ?d))
  (:action take
    :effect (key)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects front back - door)
  (:init)
  (:goal (and (open front) (open back))))",
        ],
    },
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording = Wording {
    lint: &LINT,
    about: |o| {
        o.when.is_none() && matches!(o.schema, Schema::Action(_) | Schema::Durative(_) | Schema::Event(_))
    },
    verdict: "can never apply",
};

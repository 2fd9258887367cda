//! A method that can never carry out its task.

use pddl::Explanation;

use crate::lint::Check;
use crate::reachability::Schema;
use crate::{Level, Lint};

use super::dead::{Wording, in_domain, in_problem};

pub(crate) static LINT: Lint = Lint {
    name: "dead-method",
    level: Level::Default,
    explanation: Explanation {
        code: "W0853",
        title: "method can never be used",
        meaning: "The condition of a method, or the condition of an action in it, never holds, or one of its \
         subtasks can never be carried out to the end.",
        why: "A planner tries it in vain, and the task has one way less than it seems.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp sign)
  (:predicates (lit ?x - object))
  (:task announce :parameters (?s - sign))
  (:method if-lit
    :parameters (?s - sign ?l - lamp)
    :task (announce ?s)
    :precondition (lit ?s)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp exit - sign)
  (:htn
    :ordered-subtasks (switch left))
  (:init))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :hierarchy :method-preconditions)
  (:types lamp sign)
  (:predicates (lit ?l - lamp))
  (:task announce :parameters (?s - sign))
  (:method if-lit
    :parameters (?s - sign ?l - lamp)
    :task (announce ?s)
    :precondition (lit ?l)
    :ordered-subtasks (switch ?l))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp exit - sign)
  (:htn
    :ordered-subtasks (announce exit))
  (:init (lit left)))",
        ],
    },
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording =
    Wording { lint: &LINT, about: |o| matches!(o.schema, Schema::Method(_)), verdict: "can never be used" };

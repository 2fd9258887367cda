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
        why: "A planner tries it in vain. A task all of whose methods need the task itself can never be carried \
         out: the recursion lacks its last step.",
        wrong: &["\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?l - lamp))
  (:task evening :parameters (?l - lamp))
  (:method go-on
    :parameters (?l - lamp)
    :task (evening ?l)
    :ordered-subtasks (and (switch ?l) (evening ?l)))
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))"],
        right: &["\
(define (domain hall)
  (:requirements :typing :hierarchy)
  (:types lamp)
  (:predicates (lit ?l - lamp))
  (:task evening :parameters (?l - lamp))
  (:method go-on
    :parameters (?l - lamp)
    :task (evening ?l)
    :ordered-subtasks (and (switch ?l) (evening ?l)))
  (:method stop
    :parameters (?l - lamp)
    :task (evening ?l)
    :ordered-subtasks ())
  (:action switch
    :parameters (?l - lamp)
    :effect (lit ?l)))"],
    },
    checks: &[
        Check::Domain(|view, found| in_domain(view, &WORDING, found)),
        Check::Problem(|view, found| in_problem(view, &WORDING, found)),
    ],
};

static WORDING: Wording =
    Wording { lint: &LINT, about: |o| matches!(o.schema, Schema::Method(_)), verdict: "can never be used" };

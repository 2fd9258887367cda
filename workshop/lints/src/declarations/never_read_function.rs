//! A function that effects change and nothing asks for.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{ProblemView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "never-read-function",
    level: Level::Pedantic,
    explanation: Explanation {
        code: "W0718",
        title: "function is never read",
        meaning: "Effects change a function, but no condition, duration or other effect of the domain asks for \
         its value, and no metric of the problems that were looked at. `total-cost` is not reported: it \
         is there for metrics.",
        why: "It changes nothing that can be done and makes no plan better. Often a condition such as `(> \
         (fuel ?v) 0)` is missing.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (used))
  (:action switch
    :parameters (?x - lamp)
    :effect (and (lit ?x) (increase (used) 1))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (used) 0))
  (:goal (lit left)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (used))
  (:action switch
    :parameters (?x - lamp)
    :precondition (< (used) 10)
    :effect (and (lit ?x) (increase (used) 1))))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (used) 0))
  (:goal (lit left)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    let (domain, problem) = (view.domain.usage(), view.usage());
    for (id, function) in view.domain.domain.functions.enumerate() {
        let used = domain.functions[id];
        let read = used.read || problem.functions[id].read || &*function.name == "total-cost";
        if is_here(function.span) && used.written && !read {
            let message = format!("effects change `{}`, but nothing asks for its value", function.name);
            found.report(Finding::new(&LINT, Place::domain(function.span), message));
        }
    }
}

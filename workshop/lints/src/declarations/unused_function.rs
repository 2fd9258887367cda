//! A function that nobody names.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{ProblemView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-function",
    level: Level::Default,
    explanation: Explanation {
        code: "W0706",
        title: "unused function",
        meaning: "A function is declared, but no condition, effect or duration of the domain names it, and no \
         metric of the problems that were looked at.",
        why: "Its values change nothing. A planner that refuses numbers refuses the domain for nothing.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (power ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (power left) 5))
  (:goal (lit left)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing :numeric-fluents)
  (:types lamp)
  (:predicates (lit ?x - lamp))
  (:functions (power ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (> (power ?x) 3)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (= (power left) 5))
  (:goal (lit left)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.domain.is_vocabulary() {
        return;
    }
    let (domain, problem) = (view.domain.usage(), view.usage());
    for (id, function) in view.domain.domain.functions.enumerate() {
        let used = domain.functions[id];
        if is_here(function.span) && !used.read && !used.written && !problem.functions[id].read {
            let message = format!("nothing asks for the function `{}` or changes it", function.name);
            found.report(Finding::new(&LINT, Place::domain(function.span), message));
        }
    }
}

//! A constant that nobody names.

use pddl::Explanation;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{ProblemView, is_here};
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "unused-constant",
    level: Level::Default,
    explanation: Explanation {
        code: "W0708",
        title: "unused constant",
        meaning: "A constant is declared, but the domain does not name it, and neither does any of the problems \
         that were looked at.",
        why: "A constant is there to be named by the domain. One that is not is at best an object of the \
         problem.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:constants main spare - lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :effect (lit main)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit main)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:constants main - lamp)
  (:predicates (lit ?x - lamp))
  (:action switch
    :effect (lit main)))",
            "\
(define (problem evening)
  (:domain hall)
  (:init)
  (:goal (lit main)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.domain.is_vocabulary() {
        return;
    }
    for (id, constant) in view.domain.domain.constants.enumerate() {
        if is_here(constant.span) && !view.domain.usage().names(id) && !view.usage().names(id) {
            let message = format!("nothing names the constant `{}`", constant.name);
            found.report(Finding::new(&LINT, Place::domain(constant.span), message));
        }
    }
}

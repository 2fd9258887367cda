//! A function with two initial values.

use std::collections::hash_map::Entry;

use pddl::Explanation;
use pddl::model::{FluentFact, FunctionId, ObjectId};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "conflicting-value",
    level: Level::Default,
    explanation: Explanation {
        code: "W0815",
        title: "two initial values",
        meaning: "The initial state gives a function two different values for the same objects.",
        why: "Tools differ in which one they take.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power))
  (:action switch
    :precondition (> (power) 3)
    :effect (and (lit) (decrease (power) 1))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (= (power) 5) (= (power) 7))
  (:goal (lit)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :numeric-fluents)
  (:predicates (lit))
  (:functions (power))
  (:action switch
    :precondition (> (power) 3)
    :effect (and (lit) (decrease (power) 1))))",
            "\
(define (problem evening)
  (:domain hall)
  (:init (= (power) 5))
  (:goal (lit)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let mut values: FxHashMap<(FunctionId, &[ObjectId]), &FluentFact> = FxHashMap::default();
    for fact in &view.problem.fluents {
        match values.entry((fact.application.function, &fact.application.arguments)) {
            Entry::Vacant(entry) => {
                entry.insert(fact);
            }
            Entry::Occupied(first) if first.get().value != fact.value => {
                let message = "this has another value already";
                let finding = Finding::new(&LINT, Place::problem(fact.span), message);
                found.report(finding.label(Place::problem(first.get().span), "the other one"));
            }
            Entry::Occupied(_) => {}
        }
    }
}

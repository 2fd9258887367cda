//! A fact that stands twice in `:init`.

use std::collections::hash_map::Entry;

use pddl::model::{FluentValue, FunctionId, ObjectId, PredicateId};
use pddl::{Explanation, Span};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::ProblemView;
use crate::{Finding, Level, Lint, Place};

pub(crate) static LINT: Lint = Lint {
    name: "repeated-fact",
    level: Level::Default,
    explanation: Explanation {
        code: "W0814",
        title: "fact stands twice",
        meaning: "The initial state has the same fact, or the same value of a function, twice.",
        why: "The second one says nothing. Mostly it was copied and an object should have been changed.",
        wrong: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (broken ?x)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (broken left) (broken left))
  (:goal (lit left)))",
        ],
        right: &[
            "\
(define (domain hall)
  (:requirements :typing)
  (:types lamp)
  (:predicates (lit ?x - lamp) (broken ?x - lamp))
  (:action switch
    :parameters (?x - lamp)
    :precondition (broken ?x)
    :effect (lit ?x)))",
            "\
(define (problem evening)
  (:domain hall)
  (:objects left - lamp)
  (:init (broken left))
  (:goal (lit left)))",
        ],
    },
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    let mut facts: FxHashMap<(PredicateId, &[ObjectId]), Span> = FxHashMap::default();
    for fact in &view.problem.init {
        match facts.entry((fact.predicate, &fact.arguments)) {
            Entry::Vacant(entry) => {
                entry.insert(fact.span);
            }
            Entry::Occupied(first) => twice(fact.span, *first.get(), found),
        }
    }
    let mut values: FxHashMap<(FunctionId, &[ObjectId]), (FluentValue, Span)> = FxHashMap::default();
    for fact in &view.problem.fluents {
        match values.entry((fact.application.function, &fact.application.arguments)) {
            Entry::Vacant(entry) => {
                entry.insert((fact.value, fact.span));
            }
            Entry::Occupied(first) => {
                let (value, span) = *first.get();
                if value == fact.value {
                    twice(fact.span, span, found);
                }
            }
        }
    }
}

fn twice(span: Span, first: Span, found: &mut Findings) {
    let finding = Finding::new(&LINT, Place::problem(span), "this stands here a second time");
    found.report(finding.label(Place::problem(first), "first here"));
}

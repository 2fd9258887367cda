//! A fact that stands twice in `:init`.

use std::collections::hash_map::Entry;

use pddl::Span;
use pddl::model::{FluentValue, FunctionId, ObjectId, PredicateId};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "repeated-fact",
    level: Level::Default,
    explanation: explanation!("W0814"),
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
    let finding = LINT.finding(place::problem(span), "this stands here a second time");
    found.report(finding.label(place::problem(first), "first here"));
}

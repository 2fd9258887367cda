//! A function with two initial values.

use std::collections::hash_map::Entry;

use pddl::model::{FluentFact, FunctionId, ObjectId};
use rustc_hash::FxHashMap;

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "conflicting-value",
    level: Level::Default,
    explanation: explanation!("W0815"),
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
                let finding = LINT.finding(place::problem(fact.span), message);
                found.report(finding.label(place::problem(first.get().span), "the other one"));
            }
            Entry::Occupied(_) => {}
        }
    }
}

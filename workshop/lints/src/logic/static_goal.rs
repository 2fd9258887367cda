//! A goal that holds and that nothing changes.

use pddl::model::{ObjectId, PredicateId, Term};
use rustc_hash::FxHashSet;

use super::literals::{Fact, Literal, required};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "static-goal",
    level: Level::Default,
    explanation: explanation!("W0812"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() {
        return;
    }
    for (literal, predicate) in true_initially(view) {
        let timed = view.usage().predicates[predicate].timed;
        if !timed && !view.domain.usage().predicates[predicate].fluent() {
            let name = &view.domain.domain.predicates[predicate].name;
            let message = format!("this holds from the beginning, and no action changes `{name}`");
            found.report(LINT.finding(place::problem(literal.span), message));
        }
    }
}

/// The literals of the goal that are about objects and hold in the initial state, without derived predicates.
pub(super) fn true_initially(view: &ProblemView<'_, '_>) -> Vec<(Literal, PredicateId)> {
    let mut asked: Vec<(Literal, PredicateId, Vec<ObjectId>)> = Vec::new();
    for literal in required([&view.problem.goal]) {
        if let Fact::Atom(predicate, arguments) = &literal.fact
            && !view.domain.usage().predicates[*predicate].derived
        {
            let objects: Option<Vec<ObjectId>> = arguments
                .iter()
                .map(|term| match term {
                    Term::Object(object) => Some(*object),
                    Term::Variable(_) => None,
                })
                .collect();
            if let Some(objects) = objects {
                let predicate = *predicate;
                asked.push((literal, predicate, objects));
            }
        }
    }
    let about: FxHashSet<PredicateId> = asked.iter().map(|(_, predicate, _)| *predicate).collect();
    let init = view.problem.init.iter().filter(|fact| about.contains(&fact.predicate));
    let init: FxHashSet<(PredicateId, &[ObjectId])> = init.map(|f| (f.predicate, &*f.arguments)).collect();
    asked.retain(|(literal, predicate, objects)| literal.positive == init.contains(&(*predicate, objects)));
    asked.into_iter().map(|(literal, predicate, _)| (literal, predicate)).collect()
}

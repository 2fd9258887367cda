//! A timed initial literal that changes nothing.

use pddl::model::{ObjectId, PredicateId, TimedChange};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::ProblemView;
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "timed-without-change",
    level: Level::Default,
    explanation: explanation!("W0820"),
    checks: &[Check::Problem(check)],
};

fn check(view: &ProblemView<'_, '_>, found: &mut Findings) {
    if !view.is_complete() || view.problem.timed.is_empty() {
        return;
    }
    let usage = view.domain.usage();
    let init: FxHashSet<(PredicateId, &[ObjectId])> =
        view.problem.init.iter().map(|fact| (fact.predicate, &*fact.arguments)).collect();
    let mut timed: Vec<_> = view.problem.timed.iter().collect();
    timed.sort_by_key(|t| t.time);
    let mut since: FxHashMap<(PredicateId, &[ObjectId]), bool> = FxHashMap::default();
    for change in timed {
        let (fact, becomes) = match &change.change {
            TimedChange::Add(fact) => (fact, true),
            TimedChange::Delete(fact) => (fact, false),
            TimedChange::Assign(_) | TimedChange::Undefine(_) => continue,
        };
        let key = (fact.predicate, &*fact.arguments);
        let before = since.insert(key, becomes).unwrap_or_else(|| init.contains(&key));
        if before == becomes && !usage.predicates[fact.predicate].fluent() {
            let is = if becomes { "true" } else { "false" };
            let message = format!("this is {is} already then, and no effect changes it");
            found.report(LINT.finding(place::problem(fact.span), message));
        }
    }
}

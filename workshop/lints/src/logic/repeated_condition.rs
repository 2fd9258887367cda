//! `(and (p) (p))`

use diagnostics::Place;
use std::collections::hash_map::Entry;

use rustc_hash::FxHashMap;

use super::literals::{Fact, Group, Literal, groups};
use crate::finding::Findings;
use crate::lint::{Check, explanation};
use crate::view::{DomainView, ProblemView};
use crate::{Level, Lint, place};

pub(crate) static LINT: Lint = Lint {
    name: "repeated-condition",
    level: Level::Default,
    explanation: explanation!("W0803"),
    checks: &[Check::Domain(in_domain), Check::Problem(in_goal)],
};

fn in_domain(view: &DomainView<'_>, found: &mut Findings) {
    for conditions in view.schemas().flat_map(|schema| schema.conditions()) {
        check(&groups(conditions), place::domain, found);
    }
}

fn in_goal(view: &ProblemView<'_, '_>, found: &mut Findings) {
    check(&groups([&view.problem.goal]), place::problem, found);
}

fn check(groups: &[Group<'_>], place: fn(pddl::Span) -> Place, found: &mut Findings) {
    for Group::All(parts) | Group::Any(parts) in groups {
        // A large goal is compared by hashing.
        let mut seen: FxHashMap<(Fact, bool), pddl::Span> = FxHashMap::default();
        for literal in parts.iter().filter_map(|part| Literal::of(part)) {
            match seen.entry((literal.fact, literal.positive)) {
                Entry::Vacant(entry) => {
                    entry.insert(literal.span);
                }
                Entry::Occupied(first) => {
                    let finding = LINT.finding(place(literal.span), "this stands here a second time");
                    found.report(finding.label(place(*first.get()), "first here"));
                }
            }
        }
    }
}

//! The rules of the agents: the bindings for which they may start, what they wait for, and what they write.

use std::collections::BTreeSet;

use pddl::model::{Condition, Domain, DurativeAction, DurativeActionId, Name, TimeSpecifier};

use super::bindings::{self, Meter, conjuncts};
use super::facts::{Fact, Facts};
use super::known::Known;
use super::scope::Scope;
use crate::check::tokens::Tokens;

/// What a rule does for one binding for which it may start.
#[derive(Clone, Debug)]
pub(in crate::check) struct Instance {
    /// The position of its agent.
    pub(in crate::check) agent: usize,
    pub(in crate::check) rule: DurativeActionId,
    /// The tokens that have to be true before it starts.
    pub(in crate::check) waits_for: BTreeSet<Fact>,
    /// What it writes when it starts.
    pub(in crate::check) start: Facts,
    /// What it writes at all.
    pub(in crate::check) writes: Facts,
}

/// Visits each instance of a rule.
pub(super) fn each(
    scope: &mut Scope<'_>,
    (agent, id): (usize, DurativeActionId),
    known: &Known<'_>,
    meter: &Meter,
    visit: &mut dyn FnMut(Instance),
) {
    let rule = &scope.domain.durative_actions[id];
    let (before, after) = conditions(scope.domain, rule);
    let results: &[_] = rule.rule.as_ref().map_or(&[], |rule| &rule.results);
    let parameters: Vec<_> = rule.variables.parameter_ids().collect();
    bindings::each(scope, &parameters, &before, known, meter, &mut |scope| {
        let mut start = Facts::default();
        for effect in rule.effects.iter().filter(|e| e.when == TimeSpecifier::Start) {
            scope.write(&effect.effect, &[], known, &mut start);
        }
        let during = Known { own: Some(&start), ..*known };
        if !after.iter().all(|condition| scope.may(condition, true, &during)) {
            return;
        }
        let mut waits_for = BTreeSet::new();
        for condition in before.iter().chain(&after) {
            scope.literals(condition, true, &mut |fact, positive| {
                if positive {
                    waits_for.insert(fact);
                }
            });
        }
        waits_for.retain(|fact| !start.may_hold(fact));
        let mut writes = start.clone();
        for effect in rule.effects.iter().filter(|e| e.when != TimeSpecifier::Start) {
            scope.write(&effect.effect, results, &during, &mut writes);
        }
        visit(Instance { agent, rule: id, waits_for, start, writes });
    });
}

/// The conditions of a rule: those that hold before its effects at start, and those that these effects may establish.
fn conditions<'r>(domain: &Domain, rule: &'r DurativeAction) -> (Vec<&'r Condition>, Vec<&'r Condition>) {
    let written: BTreeSet<Name> = Tokens::of(domain).effects(rule, |w| *w == TimeSpecifier::Start);
    let (mut before, mut after) = (Vec::new(), Vec::new());
    for timed in &rule.conditions {
        let mut parts = Vec::new();
        conjuncts(&timed.condition, &mut parts);
        for part in parts {
            let mut read = Tokens::of(domain);
            read.condition(part);
            let own = timed.when == TimeSpecifier::OverAll && !read.names.is_disjoint(&written);
            if own { after.push(part) } else { before.push(part) }
        }
    }
    (before, after)
}

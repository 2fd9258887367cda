//! Records changes beyond effects: derived atoms and continuous change.
//!
//! A [`Recorder`] reads the logs of derived relations and lets the state remember old values of
//! fluents. Only a trace has this cost, and only for changes.

use crate::prepared::Prepared;
use crate::relation::{Mark, Moment, Relation, Slot};
use crate::state::State;
use crate::trace::{Diff, FluentChange};
use crate::value::GroundAtom;
use pddl::model::{GroundApplication, IndexVec, PredicateId};
use rustc_hash::FxHashSet;
use std::cmp::Ordering;

/// Records the changes of a state besides effects.
#[derive(Debug)]
pub(crate) struct Recorder {
    /// By predicate: the part of its log that was read, and the slots that held then.
    derived: IndexVec<PredicateId, (Option<Mark>, FxHashSet<Slot>)>,
}

impl Recorder {
    /// Records the initial state.
    pub(crate) fn new(prepared: &Prepared<'_>, state: &mut State, initial: &mut Diff) -> Self {
        let derived = state.derived.iter().map(|_| (None, FxHashSet::default())).collect();
        let mut recorder = Self { derived };
        initial.added = atoms(&state.facts);
        initial.fluents = state
            .fluents()
            .map(|(fluent, value)| FluentChange { fluent: fluent.clone(), before: None, after: Some(value) })
            .collect();
        initial.fluents.sort_by(by_fluent);
        recorder.after(prepared, state, 0, initial);
        recorder
    }

    /// Records the state just before a happening of a plan with times.
    pub(crate) fn before(&self, state: &State, diff: &mut Diff) {
        let noted: FxHashSet<&GroundApplication> = diff.fluents.iter().map(|change| &change.fluent).collect();
        for (fluent, before) in state.remembered() {
            let after = state.fluent(fluent);
            if after.is_some() && before != after && !noted.contains(fluent) {
                diff.flowed.push(FluentChange { fluent: fluent.clone(), before, after });
            }
        }
        diff.flowed.sort_by(by_fluent);
    }

    /// Records the state right after a happening.
    pub(crate) fn after(&mut self, prepared: &Prepared<'_>, state: &mut State, now: Moment, diff: &mut Diff) {
        if prepared.domain.axioms.is_empty() {
            return;
        }
        prepared.derive(state, now);
        for (predicate, relation) in state.derived.enumerate() {
            let (seen, holding) = &mut self.derived[predicate];
            let mark = relation.mark();
            if *seen == Some(mark) {
                continue;
            }
            let changed = seen.and_then(|seen| relation.toggled(seen));
            let changed = changed.unwrap_or_else(|| relation.slots().collect());
            for slot in changed {
                let (was, is) = (holding.contains(&slot), relation.slot_holds(slot));
                let atom = || GroundAtom { predicate, arguments: relation.tuple(slot).into() };
                if is && !was {
                    holding.insert(slot);
                    diff.derived.push(atom());
                } else if was && !is {
                    holding.remove(&slot);
                    diff.no_longer_derived.push(atom());
                }
            }
            *seen = Some(mark);
        }
        diff.derived.sort();
        diff.no_longer_derived.sort();
    }

    /// Remembers values for the next [`Recorder::before`].
    pub(crate) fn settle(&mut self, state: &mut State) {
        state.remember_fluents();
    }
}

fn by_fluent(a: &FluentChange, b: &FluentChange) -> Ordering {
    let key = |change: &FluentChange| change.fluent.function;
    key(a).cmp(&key(b)).then_with(|| a.fluent.arguments.cmp(&b.fluent.arguments))
}

fn atoms(relations: &IndexVec<PredicateId, Relation>) -> Vec<GroundAtom> {
    let mut all = Vec::new();
    for (predicate, relation) in relations.enumerate() {
        all.extend(relation.holding().map(|arguments| GroundAtom { predicate, arguments: arguments.into() }));
    }
    all
}

//! What each step changed.
//!
//! Effects note what they change while they are made. What follows by axioms and what changes continuously is seen
//! by a [`Recorder`], which reads the logs of derived relations and has the state remember what fluents were: only a trace
//! pays for that, and only for what changed.

use crate::cause::Cause;
use crate::number::Number;
use crate::relation::{Mark, Relation, Slot};
use crate::run::Validator;
use crate::state::{GroundAtom, Moment, State, Value};
use crate::trajectory::Breach;
use crate::words::File;
use pddl::Span;
use pddl::model::{GroundApplication, IndexVec, Name, ObjectId, PredicateId};
use rustc_hash::FxHashSet;
use std::cmp::Ordering;

/// A fluent that got another value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FluentChange {
    /// Which one.
    pub fluent: GroundApplication,
    /// What it was; `None` is undefined.
    pub before: Option<Value>,
    /// What it is.
    pub after: Option<Value>,
}

/// What one step changed, in the order of its effects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Diff {
    /// Atoms that did not hold and now do.
    pub added: Vec<GroundAtom>,
    /// Atoms that held and no longer do.
    pub deleted: Vec<GroundAtom>,
    /// Fluents with another value.
    pub fluents: Vec<FluentChange>,
    /// Atoms that follow by axioms now and did not.
    pub derived: Vec<GroundAtom>,
    /// Atoms that followed and no longer do.
    pub no_longer_derived: Vec<GroundAtom>,
    /// Fluents that no event set and that had another value just before than after the last happening.
    pub flowed: Vec<FluentChange>,
}

/// What happened at one time: a step, or what a plan with times does at once.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Happening {
    /// When, in seconds; in a plan without times how many steps lie behind.
    pub time: Number,
    /// What happened.
    pub causes: Vec<Cause>,
    /// What it changed.
    pub diff: Diff,
}

/// Everything that happened before the plan ended or failed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trace {
    /// What holds before the first one: nothing is deleted, and no fluent has a value before.
    pub initial: Diff,
    /// In order of time.
    pub happenings: Vec<Happening>,
    /// The constraints on the whole trajectory; none if the plan failed before its end.
    pub watched: Vec<Watched>,
}

/// A constraint on the trajectory for one binding of the `forall`s around it, and where its conditions hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Watched {
    /// Whether the domain or the problem has it.
    pub file: File,
    /// Where it stands.
    pub span: Span,
    /// Whether it must hold.
    pub demand: Demand,
    /// The values of the variables of the `forall`s and `exists`s around its first condition.
    pub binding: Vec<(Name, ObjectId)>,
    /// How and, in seconds or steps, when it is broken; `None` if it is not.
    pub broken: Option<(Breach, Option<Number>)>,
    /// Each condition in it: where it stands, and from when until when it holds.
    pub conditions: Vec<(Span, Vec<Stretch>)>,
}

/// Whether a constraint must hold or should.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Demand {
    /// It must.
    Hard,
    /// It is a preference, perhaps with a name.
    Preference(Option<Name>),
}

/// A time in which something holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stretch {
    /// Its begin, in seconds or steps.
    pub from: Number,
    /// Its end; `None` is never.
    pub until: Option<Number>,
}

/// Sees what happens to a state besides effects.
#[derive(Debug)]
pub(crate) struct Recorder {
    /// Per predicate how far its log was read, and the slots that held then.
    derived: IndexVec<PredicateId, (Option<Mark>, FxHashSet<Slot>)>,
}

impl Recorder {
    /// Sees the initial state, and writes it down.
    pub(crate) fn new(validator: &Validator<'_>, state: &mut State, initial: &mut Diff) -> Self {
        let derived = state.derived.iter().map(|_| (None, FxHashSet::default())).collect();
        let mut recorder = Self { derived };
        initial.added = atoms(&state.facts);
        initial.fluents = state
            .fluents()
            .map(|(fluent, value)| FluentChange { fluent: fluent.clone(), before: None, after: Some(value) })
            .collect();
        initial.fluents.sort_by(by_fluent);
        recorder.after(validator, state, 0, initial);
        recorder
    }

    /// Sees the state just before a happening of a plan with times.
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

    /// Sees the state right after a happening.
    pub(crate) fn after(
        &mut self,
        validator: &Validator<'_>,
        state: &mut State,
        now: Moment,
        diff: &mut Diff,
    ) {
        if validator.domain.axioms.is_empty() {
            return;
        }
        validator.derive(state, now);
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

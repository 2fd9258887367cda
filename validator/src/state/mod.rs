//! The state: which atoms hold, the value of each fluent, and which step changed each of them last.
//!
//! Problem: a plan of a hundred thousand steps must not copy a state per step. Idea: one state, changed in place.
//! Each predicate has a [`Relation`], which remembers the last change of each atom. Derived atoms are kept apart from
//! the facts and are updated only on demand (`axiom`).

mod lag;
mod passage;

pub(crate) use lag::{Lag, Seen};
pub(crate) use passage::{Curves, Passage};

use crate::number::Number;
use crate::relation::Relation;
use crate::value::Value;
use crate::work::Work;
use indexmap::{Equivalent, IndexMap};
use pddl::model::{Domain, FunctionId, GroundApplication, Idx, IndexVec, ObjectId, PredicateId};
use rustc_hash::{FxBuildHasher, FxHashMap};
use std::sync::Arc;

/// A [`GroundApplication`] on loan: it has the same hash.
#[derive(Hash)]
struct Borrowed<'a> {
    function: FunctionId,
    arguments: &'a [ObjectId],
}

impl Equivalent<GroundApplication> for Borrowed<'_> {
    fn equivalent(&self, key: &GroundApplication) -> bool {
        self.function == key.function && self.arguments == key.arguments
    }
}

/// A fluent that grows as time passes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// When it was what the state has noted, in seconds.
    pub(crate) since: Number,
    /// By how much it grows in a second.
    pub(crate) slope: Number,
}

/// Fluents that run in straight lines, and the time at which the state is looked at.
#[derive(Clone, Debug)]
struct Lines {
    by_fluent: IndexMap<GroundApplication, Line, FxBuildHasher>,
    now: Number,
}

/// Facts, what follows from them, and fluents.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) facts: IndexVec<PredicateId, Relation>,
    pub(crate) derived: IndexVec<PredicateId, Relation>,
    fluents: IndexMap<GroundApplication, Value, FxBuildHasher>,
    lines: Lines,
    /// The old values of assigned fluents, if a recorder needs them.
    before: Option<FxHashMap<GroundApplication, Option<Value>>>,
    /// How often a fluent of the function was given a value.
    fluent_changes: IndexVec<FunctionId, u64>,
    /// How far `derived` lags behind the facts.
    pub(crate) lag: Lag,
    /// How fluents run through the present instant; `None` if all of them are what `fluents` says.
    pub(crate) passage: Option<Arc<Passage>>,
    /// Whether a fluent may be rounded because something happened at an instant that is no fraction.
    pub(crate) rounded: bool,
    /// The work that judging this plan may still cost.
    pub(crate) work: Work,
}

impl State {
    /// Nothing holds. `joined` says which predicates are looked up by pattern.
    pub(crate) fn empty(domain: &Domain, joined: &[bool]) -> Self {
        let relations = || {
            domain
                .predicates
                .enumerate()
                .map(|(id, p)| {
                    if joined.get(id.index()).copied().unwrap_or(false) {
                        Relation::indexed(p.variables.parameters)
                    } else {
                        Relation::plain()
                    }
                })
                .collect()
        };
        Self {
            facts: relations(),
            derived: relations(),
            fluents: IndexMap::default(),
            lines: Lines { by_fluent: IndexMap::default(), now: Number::ZERO },
            before: None,
            fluent_changes: domain.functions.iter().map(|_| 0).collect(),
            lag: Lag::default(),
            passage: None,
            rounded: false,
            work: Work::default(),
        }
    }

    pub(crate) fn holds(&self, predicate: PredicateId, arguments: &[ObjectId]) -> bool {
        self.facts[predicate].holds(arguments) || self.derived[predicate].holds(arguments)
    }

    pub(crate) fn fluent(&self, application: &GroundApplication) -> Option<Value> {
        let value = *self.fluents.get(application)?;
        if self.lines.by_fluent.is_empty() {
            return Some(value);
        }
        self.on_line(self.lines.by_fluent.get(application), value)
    }

    /// The same without a key of its own.
    pub(crate) fn fluent_of(&self, function: FunctionId, arguments: &[ObjectId]) -> Option<Value> {
        let fluent = Borrowed { function, arguments };
        let value = *self.fluents.get(&fluent)?;
        if self.lines.by_fluent.is_empty() {
            return Some(value);
        }
        self.on_line(self.lines.by_fluent.get(&fluent), value)
    }

    /// What a fluent is now, if it was `value` when its line began.
    fn on_line(&self, line: Option<&Line>, value: Value) -> Option<Value> {
        let (Some(line), Value::Number(number)) = (line, value) else { return Some(value) };
        let passed = self.lines.now.minus(line.since).ok()?;
        let number = line.slope.times(passed).and_then(|more| number.plus(more)).ok()?;
        if !number.is_exact() {
            self.work.mark_undecided();
        }
        Some(Value::Number(number))
    }

    /// From now on a fluent grows from its value.
    pub(crate) fn draw_line(&mut self, fluent: GroundApplication, line: Line) {
        self.lines.by_fluent.insert(fluent, line);
    }

    pub(crate) fn line(&self, fluent: &GroundApplication) -> Option<&Line> {
        self.lines.by_fluent.get(fluent)
    }

    pub(crate) fn lines(&self) -> impl Iterator<Item = (&GroundApplication, &Line)> {
        self.lines.by_fluent.iter()
    }

    pub(crate) fn has_lines(&self) -> bool {
        !self.lines.by_fluent.is_empty()
    }

    /// Looks at fluents that run in lines as they are at a time.
    pub(crate) fn look_at(&mut self, time: Number) {
        self.lines.now = time;
    }

    /// Ends all lines where they are.
    pub(crate) fn settle_lines(&mut self) {
        let fluents: Vec<GroundApplication> = self.lines.by_fluent.keys().cloned().collect();
        for fluent in fluents {
            let value = self.fluent(&fluent);
            self.set_fluent(fluent, value);
        }
    }

    /// How often a fluent of the function was given a value.
    pub(crate) fn fluent_changes(&self, function: FunctionId) -> u64 {
        self.fluent_changes[function]
    }

    /// All that have a value, in no order.
    pub(crate) fn fluents(&self) -> impl Iterator<Item = (&GroundApplication, Value)> {
        self.fluents.iter().filter_map(|(fluent, _)| Some((fluent, self.fluent(fluent)?)))
    }

    /// Begins to remember what fluents were.
    pub(crate) fn remember_fluents(&mut self) {
        self.before.get_or_insert_default().clear();
    }

    /// The fluents that were given a value since [`State::remember_fluents`], with what they were, in no order.
    pub(crate) fn remembered(&self) -> impl Iterator<Item = (&GroundApplication, Option<Value>)> {
        self.before.iter().flatten().map(|(fluent, &before)| (fluent, before))
    }

    /// Gives a fluent a value, or takes it away.
    pub(crate) fn set_fluent(&mut self, application: GroundApplication, value: Option<Value>) {
        self.fluent_changes[application.function] += 1;
        if !self.lines.by_fluent.is_empty() {
            self.lines.by_fluent.swap_remove(&application);
        }
        if let Some(before) = &mut self.before
            && !before.contains_key(&application)
        {
            before.insert(application.clone(), self.fluents.get(&application).copied());
        }
        if let Some(passage) = &mut self.passage {
            Arc::make_mut(passage).forget(&application);
        }
        match value {
            Some(value) => self.fluents.insert(application, value),
            None => self.fluents.swap_remove(&application),
        };
    }
}

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

/// A fluent that changes linearly with time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    /// The time at which the fluent had its stored value, in seconds.
    pub(crate) since: Number,
    /// The change per second.
    pub(crate) slope: Number,
}

/// The fluents that change linearly, and the time at which they are read.
#[derive(Clone, Debug)]
struct Lines {
    by_fluent: IndexMap<GroundApplication, Line, FxBuildHasher>,
    now: Number,
}

/// The facts, the derived atoms and the fluents.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) facts: IndexVec<PredicateId, Relation>,
    pub(crate) derived: IndexVec<PredicateId, Relation>,
    fluents: IndexMap<GroundApplication, Value, FxBuildHasher>,
    lines: Lines,
    /// The old values of assigned fluents, if a recorder needs them.
    before: Option<FxHashMap<GroundApplication, Option<Value>>>,
    /// By function: how often one of its fluents was assigned a value.
    fluent_changes: IndexVec<FunctionId, u64>,
    /// How far `derived` lags behind the facts.
    pub(crate) lag: Lag,
    /// The curves of the fluents through the present instant; `None` if every fluent has its value in `fluents`.
    pub(crate) passage: Option<Arc<Passage>>,
    /// Whether a fluent may be rounded, because of a happening at an instant that is not a fraction.
    pub(crate) rounded: bool,
    /// The rest of the budget for this plan.
    pub(crate) work: Work,
}

impl State {
    /// A state in which nothing holds. `joined` marks the predicates that are looked up by pattern.
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

    /// The value of a fluent, without an owned key.
    pub(crate) fn fluent_of(&self, function: FunctionId, arguments: &[ObjectId]) -> Option<Value> {
        let fluent = Borrowed { function, arguments };
        let value = *self.fluents.get(&fluent)?;
        if self.lines.by_fluent.is_empty() {
            return Some(value);
        }
        self.on_line(self.lines.by_fluent.get(&fluent), value)
    }

    /// The present value of a fluent that had `value` when its line began.
    fn on_line(&self, line: Option<&Line>, value: Value) -> Option<Value> {
        let (Some(line), Value::Number(number)) = (line, value) else { return Some(value) };
        let passed = self.lines.now.minus(line.since).ok()?;
        let number = line.slope.times(passed).and_then(|more| number.plus(more)).ok()?;
        if !number.is_exact() {
            self.work.mark_undecided();
        }
        Some(Value::Number(number))
    }

    /// Lets a fluent change linearly from its value.
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

    /// Sets the time at which linearly changing fluents are read.
    pub(crate) fn look_at(&mut self, time: Number) {
        self.lines.now = time;
    }

    /// Ends all lines; each fluent keeps its present value.
    pub(crate) fn settle_lines(&mut self) {
        let fluents: Vec<GroundApplication> = self.lines.by_fluent.keys().cloned().collect();
        for fluent in fluents {
            let value = self.fluent(&fluent);
            self.set_fluent(fluent, value);
        }
    }

    /// How often a fluent of the function was assigned a value.
    pub(crate) fn fluent_changes(&self, function: FunctionId) -> u64 {
        self.fluent_changes[function]
    }

    /// All fluents that have a value, in no particular order.
    pub(crate) fn fluents(&self) -> impl Iterator<Item = (&GroundApplication, Value)> {
        self.fluents.iter().filter_map(|(fluent, _)| Some((fluent, self.fluent(fluent)?)))
    }

    /// Begins to record the old values of assigned fluents.
    pub(crate) fn remember_fluents(&mut self) {
        self.before.get_or_insert_default().clear();
    }

    /// The fluents assigned since [`State::remember_fluents`], with their old values, in no particular order.
    pub(crate) fn remembered(&self) -> impl Iterator<Item = (&GroundApplication, Option<Value>)> {
        self.before.iter().flatten().map(|(fluent, &before)| (fluent, before))
    }

    /// Assigns a value to a fluent, or makes it undefined.
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

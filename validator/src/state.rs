//! The state: which atoms hold, what each fluent is, and which step made it so.
//!
//! A plan of a hundred thousand steps must not copy a state per step, so there is one, changed in place.
//! Each predicate has a [`Relation`]: a map from argument tuples to records, which only grows; an atom
//! that was deleted keeps its record, and with it the step that deleted it. Predicates that quantifiers,
//! axioms or universal effects look up by pattern also have an index per argument position. Cost: one
//! hash of the arguments per look-up or change.

use crate::effort::Effort;
use crate::number::Number;
use indexmap::IndexMap;
use pddl::model::{Domain, FluentValue, GroundApplication, Idx, IndexVec, ObjectId, PredicateId};
use rustc_hash::{FxBuildHasher, FxHashMap};

/// A predicate of objects.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GroundAtom {
    /// Which predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
}

/// What a fluent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// A number.
    Number(Number),
    /// An object.
    Object(ObjectId),
}

impl Value {
    /// What a file gives a fluent; `None` if it is no finite number.
    pub(crate) fn of(value: FluentValue) -> Option<Self> {
        match value {
            FluentValue::Number(number) => Number::from_f64(number).map(Self::Number),
            FluentValue::Object(object) => Some(Self::Object(object)),
        }
    }
}

/// A moment of the plan: 0 before the first step, `n` after step `n`.
pub(crate) type Moment = u32;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Record {
    pub(crate) holds: bool,
    /// When it last became what it is.
    pub(crate) since: Moment,
    /// When it was last added, needed or not: an add wins over a delete of the same moment.
    added: Moment,
}

/// The extension of one predicate.
#[derive(Clone, Debug, Default)]
pub(crate) struct Relation {
    records: IndexMap<Box<[ObjectId]>, Record, FxBuildHasher>,
    positions: Vec<FxHashMap<ObjectId, Vec<u32>>>,
}

impl Relation {
    pub(crate) fn plain() -> Self {
        Self::default()
    }

    pub(crate) fn indexed(arity: usize) -> Self {
        Self { records: IndexMap::default(), positions: vec![FxHashMap::default(); arity] }
    }

    pub(crate) fn record(&self, arguments: &[ObjectId]) -> Option<Record> {
        self.records.get(arguments).copied()
    }

    pub(crate) fn holds(&self, arguments: &[ObjectId]) -> bool {
        self.records.get(arguments).is_some_and(|r| r.holds)
    }

    /// Adds; answers whether it did not hold.
    pub(crate) fn add(&mut self, arguments: &[ObjectId], now: Moment) -> bool {
        if let Some(record) = self.records.get_mut(arguments) {
            record.added = now;
            let new = !record.holds;
            if new {
                record.holds = true;
                record.since = now;
            }
            return new;
        }
        let slot = u32::try_from(self.records.len()).expect("fewer than 2^32 atoms fit into memory");
        for (position, &object) in self.positions.iter_mut().zip(arguments) {
            position.entry(object).or_default().push(slot);
        }
        self.records.insert(arguments.into(), Record { holds: true, since: now, added: now });
        true
    }

    /// Deletes, unless it was added at the same moment; answers whether it held.
    pub(crate) fn delete(&mut self, arguments: &[ObjectId], now: Moment) -> bool {
        match self.records.get_mut(arguments) {
            Some(record) if record.holds && record.added != now => {
                record.holds = false;
                record.since = now;
                true
            }
            _ => false,
        }
    }

    /// The tuples that hold, in order of first appearance.
    pub(crate) fn holding(&self) -> impl Iterator<Item = &[ObjectId]> {
        self.records.iter().filter(|(_, record)| record.holds).map(|(arguments, _)| &**arguments)
    }

    pub(crate) fn clear(&mut self) {
        self.records.clear();
        for position in &mut self.positions {
            position.clear();
        }
    }

    /// At most how many tuples agree with `fixed` (`None` is free).
    pub(crate) fn estimate(&self, fixed: &[Option<ObjectId>]) -> usize {
        self.narrowest(fixed).map_or(self.records.len(), <[u32]>::len)
    }

    fn narrowest(&self, fixed: &[Option<ObjectId>]) -> Option<&[u32]> {
        self.positions
            .iter()
            .zip(fixed)
            .filter_map(|(position, object)| {
                object.map(|o| position.get(&o).map_or(&[] as &[u32], Vec::as_slice))
            })
            .min_by_key(|slots| slots.len())
    }

    /// The tuples that hold among those that may agree with `fixed`, in order of first appearance.
    pub(crate) fn candidates(&self, fixed: &[Option<ObjectId>]) -> impl Iterator<Item = &[ObjectId]> {
        let narrow = self.narrowest(fixed);
        let all = if narrow.is_none() { self.records.len() } else { 0 };
        let slots = narrow.unwrap_or(&[]).iter().map(|&slot| slot as usize);
        slots.chain(0..all).filter_map(|slot| {
            let (arguments, record) = self.records.get_index(slot)?;
            record.holds.then_some(&**arguments)
        })
    }
}

/// Facts, what follows from them, and fluents.
#[derive(Clone, Debug)]
pub(crate) struct State {
    pub(crate) facts: IndexVec<PredicateId, Relation>,
    pub(crate) derived: IndexVec<PredicateId, Relation>,
    fluents: FxHashMap<GroundApplication, Value>,
    /// Whether `derived` may lag behind the facts.
    pub(crate) stale: bool,
    /// What may still be spent on the plan whose state this is.
    pub(crate) effort: Effort,
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
            fluents: FxHashMap::default(),
            stale: true,
            effort: Effort::default(),
        }
    }

    pub(crate) fn holds(&self, predicate: PredicateId, arguments: &[ObjectId]) -> bool {
        self.facts[predicate].holds(arguments) || self.derived[predicate].holds(arguments)
    }

    pub(crate) fn fluent(&self, application: &GroundApplication) -> Option<Value> {
        self.fluents.get(application).copied()
    }

    /// All that have a value, in no order.
    pub(crate) fn fluents(&self) -> impl Iterator<Item = (&GroundApplication, Value)> {
        self.fluents.iter().map(|(fluent, &value)| (fluent, value))
    }

    /// Gives a fluent a value, or takes it away.
    pub(crate) fn set_fluent(&mut self, application: GroundApplication, value: Option<Value>) {
        match value {
            Some(value) => self.fluents.insert(application, value),
            None => self.fluents.remove(&application),
        };
    }
}

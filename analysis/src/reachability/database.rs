//! Relations as sets of rows, with hash indices on the positions that joins ask for.
//!
//! Invariant: rows are numbered in the order in which they came, initial facts first; an index holds
//! the rows that were there when it was made and those that [`Database::publish`] names since, so
//! that rows can be added while a bucket is walked. Keys are hashes: the caller that walks a bucket compares
//! the row itself. Cost: a hash per row and index.

use std::hash::Hasher;

use rustc_hash::{FxHashMap, FxHasher};

/// A relation: a predicate, an object fluent with its value, or a task.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct RelationId(pub(crate) u32);

#[derive(Default)]
struct Relation {
    arity: usize,
    values: Vec<u32>,
    count: u32,
    initial: u32,
    first: FxHashMap<u64, u32>,
    /// The next older row with the same hash.
    older: Vec<u32>,
}

/// The rows of all relations.
#[derive(Default)]
pub(crate) struct Rows {
    relations: Vec<Relation>,
}

const NONE: u32 = u32::MAX;

fn hash(values: impl Iterator<Item = u32>) -> u64 {
    let mut hasher = FxHasher::default();
    values.for_each(|v| hasher.write_u32(v));
    hasher.finish()
}

impl Rows {
    /// A new relation.
    pub(crate) fn declare(&mut self, arity: usize) -> RelationId {
        self.relations.push(Relation { arity, ..Relation::default() });
        RelationId(u32::try_from(self.relations.len() - 1).expect("relations are few"))
    }

    /// How many relations there are.
    pub(crate) fn relations(&self) -> usize {
        self.relations.len()
    }

    /// How many rows.
    pub(crate) fn count(&self, relation: RelationId) -> u32 {
        self.relations[relation.0 as usize].count
    }

    /// What is there now is initial.
    pub(crate) fn seal(&mut self) {
        self.relations.iter_mut().for_each(|r| r.initial = r.count);
    }

    /// Whether the row was there from the start.
    pub(crate) fn is_initial(&self, relation: RelationId, values: &[u32]) -> bool {
        self.find(relation, values).is_some_and(|r| r < self.relations[relation.0 as usize].initial)
    }

    /// A row.
    pub(crate) fn row(&self, relation: RelationId, row: u32) -> &[u32] {
        let relation = &self.relations[relation.0 as usize];
        &relation.values[row as usize * relation.arity..][..relation.arity]
    }

    /// The number of the row with these values.
    pub(crate) fn find(&self, relation: RelationId, values: &[u32]) -> Option<u32> {
        let own = &self.relations[relation.0 as usize];
        let mut at = *own.first.get(&hash(values.iter().copied()))?;
        while at != NONE && self.row(relation, at) != values {
            at = own.older[at as usize];
        }
        (at != NONE).then_some(at)
    }

    /// Adds a row; its number if it is new.
    pub(crate) fn insert(&mut self, relation: RelationId, values: &[u32]) -> Option<u32> {
        if self.find(relation, values).is_some() {
            return None;
        }
        let own = &mut self.relations[relation.0 as usize];
        let number = own.count;
        own.values.extend_from_slice(values);
        own.count += 1;
        own.older.push(own.first.insert(hash(values.iter().copied()), number).unwrap_or(NONE));
        Some(number)
    }
}

struct Index {
    relation: RelationId,
    positions: Box<[usize]>,
    /// The newest row of each key.
    newest: FxHashMap<u64, u32>,
    /// The next older row of the same key, by row.
    older: Vec<u32>,
}

impl Index {
    fn file(&mut self, rows: &Rows, row: u32) {
        let values = rows.row(self.relation, row);
        let key = hash(self.positions.iter().map(|&p| values[p]));
        let before = self.newest.insert(key, row).unwrap_or(NONE);
        debug_assert_eq!(self.older.len(), row as usize, "rows are filed in order");
        self.older.push(before);
    }
}

/// The indices of all relations.
#[derive(Default)]
pub(crate) struct Indices {
    all: Vec<Index>,
    of: FxHashMap<RelationId, Vec<usize>>,
}

impl Indices {
    /// Lets the indices of its relation know the row.
    pub(crate) fn publish(&mut self, rows: &Rows, relation: RelationId, row: u32) {
        for &index in self.of.get(&relation).into_iter().flatten() {
            self.all[index].file(rows, row);
        }
    }

    /// The index on these positions, made from the first `visible` rows if it is new.
    pub(crate) fn on(
        &mut self,
        rows: &Rows,
        relation: RelationId,
        positions: &[usize],
        visible: u32,
    ) -> usize {
        let own = self.of.entry(relation).or_default();
        if let Some(&i) = own.iter().find(|&&i| *self.all[i].positions == *positions) {
            return i;
        }
        own.push(self.all.len());
        let mut index =
            Index { relation, positions: positions.into(), newest: FxHashMap::default(), older: Vec::new() };
        (0..visible).for_each(|row| index.file(rows, row));
        self.all.push(index);
        self.all.len() - 1
    }

    /// Rows per key, on average.
    pub(crate) fn fan_out(&self, index: usize, rows: &Rows) -> f64 {
        let index = &self.all[index];
        f64::from(rows.count(index.relation)) / index.newest.len().max(1) as f64
    }

    /// Rows that may have these values at the index's positions, the newest first.
    pub(crate) fn bucket(
        &self,
        index: usize,
        values: &dyn Fn(usize) -> u32,
    ) -> impl Iterator<Item = u32> + use<'_> {
        let index = &self.all[index];
        let key = hash(index.positions.iter().map(|&p| values(p)));
        let next = |&row: &u32| Some(index.older[row as usize]).filter(|&older| older != NONE);
        std::iter::successors(index.newest.get(&key).copied(), next)
    }
}

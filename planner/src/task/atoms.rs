//! Ground atoms, numbered in the order of discovery.
//!
//! Problem: a join looks up atoms millions of times. Idea: pack the arguments of an atom into one
//! 64-bit key. If they do not fit, a prefix gets a number, which replaces it in the key. Invariant:
//! the keys of one predicate are injective.

use crate::ids::id32;
use pddl::model::{ObjectId, PredicateId};
use rustc_hash::FxHashMap;

/// Packs rows of object numbers into 64-bit keys.
#[derive(Clone, Debug, Default)]
pub(crate) struct RowKeys {
    bits: u32,
    prefixes: FxHashMap<(u64, u32), u32>,
}

impl RowKeys {
    pub(crate) fn new(objects: usize) -> Self {
        Self { bits: (usize::BITS - objects.leading_zeros()).max(1), prefixes: FxHashMap::default() }
    }

    /// The key of a row, if every prefix that it needs is known.
    pub(crate) fn find(&self, row: impl Iterator<Item = u32>) -> Option<u64> {
        let (mut key, mut used) = (0_u64, 0);
        for (i, item) in row.enumerate() {
            if used + self.bits > 64 {
                key = u64::from(*self.prefixes.get(&(key, id32(i)))?);
                used = 32;
            }
            key = key << self.bits | u64::from(item);
            used += self.bits;
        }
        Some(key)
    }

    /// The key of a row; numbers its prefixes if necessary.
    pub(crate) fn key(&mut self, row: impl Iterator<Item = u32>) -> u64 {
        let (mut key, mut used) = (0_u64, 0);
        for (i, item) in row.enumerate() {
            if used + self.bits > 64 {
                let next = id32(self.prefixes.len());
                key = u64::from(*self.prefixes.entry((key, id32(i))).or_insert(next));
                used = 32;
            }
            key = key << self.bits | u64::from(item);
            used += self.bits;
        }
        key
    }
}

/// All known atoms.
#[derive(Clone, Debug, Default)]
pub(crate) struct AtomTable {
    keys: RowKeys,
    by_key: Vec<FxHashMap<u64, u32>>,
    predicates: Vec<PredicateId>,
    starts: Vec<u32>,
    arguments: Vec<u32>,
}

impl AtomTable {
    pub(crate) fn new(predicates: usize, objects: usize) -> Self {
        Self {
            keys: RowKeys::new(objects),
            by_key: vec![FxHashMap::default(); predicates],
            starts: vec![0],
            ..Self::default()
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.predicates.len()
    }

    pub(crate) fn find(&self, predicate: PredicateId, row: impl Iterator<Item = u32>) -> Option<u32> {
        self.by_key[predicate.0 as usize].get(&self.keys.find(row)?).copied()
    }

    /// The number of an atom; a new one if it was unknown.
    pub(crate) fn insert(&mut self, predicate: PredicateId, row: impl Iterator<Item = u32> + Clone) -> u32 {
        let key = self.keys.key(row.clone());
        let next = id32(self.predicates.len());
        let id = *self.by_key[predicate.0 as usize].entry(key).or_insert(next);
        if id == next {
            self.predicates.push(predicate);
            self.arguments.extend(row);
            self.starts.push(id32(self.arguments.len()));
        }
        id
    }

    pub(crate) fn predicate(&self, atom: u32) -> PredicateId {
        self.predicates[atom as usize]
    }

    pub(crate) fn row(&self, atom: u32) -> &[u32] {
        let i = atom as usize;
        &self.arguments[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    pub(crate) fn objects(&self, atom: u32) -> Box<[ObjectId]> {
        self.row(atom).iter().map(|&o| ObjectId(o)).collect()
    }
}

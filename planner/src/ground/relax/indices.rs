//! Hash indices of atoms on the positions that joins look up.

use crate::ground::binding::resolve;
use crate::task::{AtomTable, RowKeys};
use pddl::model::{PredicateId, Term};
use rustc_hash::FxHashMap;

/// One hash index of a predicate.
#[derive(Default)]
struct Index {
    positions: Box<[usize]>,
    buckets: FxHashMap<u64, Vec<u32>>,
}

/// All indices that some plan uses.
#[derive(Default)]
pub(crate) struct Indices {
    packing: RowKeys,
    all: Vec<Index>,
    of_predicate: Vec<Vec<usize>>,
}

impl Indices {
    pub(super) fn new(predicates: usize, objects: usize) -> Self {
        Self { packing: RowKeys::new(objects), all: Vec::new(), of_predicate: vec![Vec::new(); predicates] }
    }

    /// The index of `predicate` on these positions.
    pub(crate) fn on(&mut self, predicate: PredicateId, positions: &[usize]) -> usize {
        let own = &mut self.of_predicate[predicate.0 as usize];
        if let Some(&i) = own.iter().find(|&&i| *self.all[i].positions == *positions) {
            return i;
        }
        own.push(self.all.len());
        self.all.push(Index { positions: positions.into(), buckets: FxHashMap::default() });
        self.all.len() - 1
    }

    pub(super) fn insert(&mut self, table: &AtomTable, atom: u32) {
        let row = table.row(atom);
        for &i in &self.of_predicate[table.predicate(atom).0 as usize] {
            let index = &mut self.all[i];
            let key = self.packing.key(index.positions.iter().map(|&p| row[p]));
            index.buckets.entry(key).or_default().push(atom);
        }
    }

    pub(super) fn bucket(&self, index: usize, key: &[Term], binding: &[u32]) -> &[u32] {
        self.packing
            .find(key.iter().map(|&t| resolve(t, binding)))
            .and_then(|key| self.all[index].buckets.get(&key))
            .map_or(&[], Vec::as_slice)
    }
}

//! Numbers the numeric fluents and comparisons of instances in the order in which they are found.

use super::folded::Comparison;
use crate::ground::normalise::Key;
use crate::ids::id32;
use crate::number::Expression;
use rustc_hash::FxHashMap;

/// Fluents and comparisons, numbered in the order in which they are found.
#[derive(Clone, Debug, Default)]
pub(crate) struct Numbers {
    fluents: FxHashMap<Key, u32>,
    pub(crate) keys: Vec<Key>,
    comparisons: FxHashMap<Comparison<u32>, u32>,
    /// The atoms of comparisons.
    pub(crate) atoms: Vec<(u32, Comparison<u32>)>,
}

impl Numbers {
    pub(crate) fn fluent(&mut self, key: &Key) -> u32 {
        if let Some(&known) = self.fluents.get(key) {
            return known;
        }
        let next = id32(self.keys.len());
        self.keys.push(key.clone());
        self.fluents.insert(key.clone(), next);
        next
    }

    pub(crate) fn expression(&mut self, expression: &Expression<Key>) -> Expression<u32> {
        expression.map(&mut |key| self.fluent(key))
    }

    /// The atom of a comparison: `next` if the comparison is new.
    pub(crate) fn comparison(&mut self, comparison: &Comparison<Key>, next: u32) -> u32 {
        let own =
            Comparison { relation: comparison.relation, expression: self.expression(&comparison.expression) };
        if let Some(&atom) = self.comparisons.get(&own) {
            return atom;
        }
        self.atoms.push((next, own.clone()));
        self.comparisons.insert(own, next);
        next
    }
}

//! Conditions and effects of many operators in shared arrays.

use super::literals::LiteralsRef;
use crate::ids::{FactId, id32};

/// Effects with a condition on the state before.
#[derive(Clone, Copy, Debug)]
pub struct ConditionalEffect<'a> {
    /// The condition of the effects.
    pub condition: LiteralsRef<'a>,
    /// Facts that become true.
    pub adds: &'a [FactId],
    /// Facts that become false unless another effect adds them.
    pub deletes: &'a [FactId],
}

/// Where the parts of a block end: positive and negative condition, adds, deletes.
pub(super) type Ends = [u32; 4];

/// Blocks of four lists of facts each.
#[derive(Clone, Debug, Default)]
pub(super) struct Blocks {
    pub(super) ends: Vec<Ends>,
    pub(super) facts: Vec<FactId>,
}

/// A block's lists.
#[derive(Clone, Copy)]
pub(super) struct Block<'a> {
    pub(super) condition: LiteralsRef<'a>,
    pub(super) adds: &'a [FactId],
    pub(super) deletes: &'a [FactId],
}

impl Blocks {
    pub(super) fn push(&mut self, lists: [&[FactId]; 4]) {
        let ends = lists.map(|list| {
            self.facts.extend_from_slice(list);
            id32(self.facts.len())
        });
        self.ends.push(ends);
    }

    pub(super) fn get(&self, i: usize) -> Block<'_> {
        let start = if i == 0 { 0 } else { self.ends[i - 1][3] };
        let [positive, negative, adds, deletes] = self.ends[i];
        let part = |from: u32, to: u32| &self.facts[from as usize..to as usize];
        Block {
            condition: LiteralsRef { positive: part(start, positive), negative: part(positive, negative) },
            adds: part(negative, adds),
            deletes: part(adds, deletes),
        }
    }
}

/// The conditional effects of an operator.
#[derive(Clone, Copy, Debug)]
pub struct ConditionalEffects<'a> {
    pub(super) blocks: &'a Blocks,
    pub(super) first: usize,
    pub(super) end: usize,
}

impl<'a> ConditionalEffects<'a> {
    /// Whether the list is empty.
    pub fn is_empty(self) -> bool {
        self.first == self.end
    }

    /// The number of conditional effects.
    pub fn len(self) -> usize {
        self.end - self.first
    }

    /// Iterates over the conditional effects.
    pub fn iter(self) -> impl ExactSizeIterator<Item = ConditionalEffect<'a>> + Clone {
        (self.first..self.end).map(move |i| {
            let Block { condition, adds, deletes } = self.blocks.get(i);
            ConditionalEffect { condition, adds, deletes }
        })
    }
}

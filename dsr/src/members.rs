//! The nodes of each type, as sets of bits in pages: a bit per node where a type is dense, 64 bytes where not.

use std::sync::Arc;

use crate::id::{NodeId, TypeId};
use crate::pages::Pages;

const WORDS: usize = 8;
const BITS: usize = WORDS * 64;

type Set = Pages<[u64; WORDS]>;

/// Per type, the nodes of exactly that type.
#[derive(Debug, Clone)]
pub(crate) struct Members {
    types: Arc<[Set]>,
}

impl Members {
    pub(crate) fn new(types: usize) -> Self {
        Self { types: std::iter::repeat_with(Set::default).take(types).collect() }
    }

    pub(crate) fn insert(&mut self, node_type: TypeId, id: NodeId) {
        if let Some(set) = Arc::make_mut(&mut self.types).get_mut(node_type.index()) {
            let at = id.index() % BITS;
            set.make(id.index() / BITS)[at / 64] |= 1 << (at % 64);
        }
    }

    pub(crate) fn remove(&mut self, node_type: TypeId, id: NodeId) {
        if let Some(set) = Arc::make_mut(&mut self.types).get_mut(node_type.index())
            && let Some(words) = set.get_mut(id.index() / BITS)
        {
            let at = id.index() % BITS;
            words[at / 64] &= !(1 << (at % 64));
        }
    }

    /// Ascending.
    pub(crate) fn of(&self, node_type: TypeId) -> impl Iterator<Item = NodeId> + '_ {
        let blocks = self.types.get(node_type.index()).into_iter().flat_map(Pages::iter);
        let words = blocks.flat_map(|(block, words)| {
            words.iter().enumerate().map(move |(word, bits)| (block * BITS + word * 64, *bits))
        });
        words.flat_map(|(start, bits)| {
            let rest = |bits: &u64| Some(bits & (bits - 1)).filter(|bits| *bits != 0);
            let each = std::iter::successors(Some(bits).filter(|bits| *bits != 0), rest);
            each.map(move |bits| NodeId::at(start + bits.trailing_zeros() as usize))
        })
    }
}

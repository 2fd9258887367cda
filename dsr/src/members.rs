//! The nodes of each type, as bit sets in pages. Cost: one bit per node of a dense type, up to 64 bytes per node of a
//! sparse one.

use std::sync::Arc;

use crate::id::{NodeId, TypeId};
use crate::pages::Pages;

const WORDS: usize = 8;
const BITS: usize = WORDS * 64;

type Set = Pages<[u64; WORDS]>;

/// The nodes of exactly one type, and their number.
#[derive(Debug, Clone, Default)]
struct Kind {
    set: Set,
    count: usize,
}

/// For each type, the nodes of exactly that type.
#[derive(Debug, Clone)]
pub(crate) struct Members {
    types: Arc<[Kind]>,
}

impl Members {
    pub(crate) fn new(types: usize) -> Self {
        Self { types: std::iter::repeat_with(Kind::default).take(types).collect() }
    }

    pub(crate) fn insert(&mut self, node_type: TypeId, id: NodeId) {
        if let Some(kind) = Arc::make_mut(&mut self.types).get_mut(node_type.index()) {
            let at = id.index() % BITS;
            let word = &mut kind.set.make(id.index() / BITS)[at / 64];
            kind.count += usize::from(*word >> (at % 64) & 1 == 0);
            *word |= 1 << (at % 64);
        }
    }

    pub(crate) fn remove(&mut self, node_type: TypeId, id: NodeId) {
        if let Some(Kind { set, count }) = Arc::make_mut(&mut self.types).get_mut(node_type.index())
            && let Some(words) = set.get_mut(id.index() / BITS)
        {
            let at = id.index() % BITS;
            *count -= usize::from(words[at / 64] >> (at % 64) & 1 == 1);
            words[at / 64] &= !(1 << (at % 64));
        }
    }

    /// The number of nodes of exactly this type.
    pub(crate) fn count(&self, node_type: TypeId) -> usize {
        self.types.get(node_type.index()).map_or(0, |kind| kind.count)
    }

    /// The nodes of exactly this type, ascending.
    pub(crate) fn of(&self, node_type: TypeId) -> impl Iterator<Item = NodeId> + '_ {
        let blocks = self.types.get(node_type.index()).into_iter().flat_map(|kind| kind.set.iter());
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

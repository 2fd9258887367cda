//! A sparse array of blocks that is written in place, and copied on write only while another copy shares the block.
//!
//! Problem: readers keep old states of a graph with 10^6 nodes while writers go on; most of the time, no reader keeps
//! one. Idea: a radix tree behind `Arc` over blocks of plain cells. A copy is one reference count. A write checks at
//! each level whether this copy is the only one, and copies that level only if it is not. The tables are narrow (32
//! entries), because copying a table touches the reference count of each block below it, and those lie apart in memory.
//! The tree is as high as its largest index needs: the few hundred nodes of a robot fit in one table.
//!
//! Cost: a read is one dependent load per level and one for the block, four at most. A write to an array without
//! another copy adds an atomic exchange per level. A write to a shared one copies, once per block and copy, 64
//! reference counts, the root and one block.

use std::sync::Arc;

const BITS: u32 = 5;
const FANOUT: usize = 1 << BITS;

type Table<T> = [Option<Arc<T>>; FANOUT];
type Lower<B> = Table<B>;
type Upper<B> = Table<Lower<B>>;

/// The tree, by its height.
#[derive(Debug)]
enum Root<B> {
    /// Up to 32 blocks.
    Lower(Arc<Lower<B>>),
    /// Up to 1,024.
    Upper(Arc<Upper<B>>),
    /// Any number.
    Top(Arc<[Option<Arc<Upper<B>>>]>),
}

#[derive(Debug)]
pub(crate) struct Pages<B> {
    root: Option<Root<B>>,
}

impl<B> Clone for Root<B> {
    fn clone(&self) -> Self {
        match self {
            Self::Lower(table) => Self::Lower(Arc::clone(table)),
            Self::Upper(table) => Self::Upper(Arc::clone(table)),
            Self::Top(tables) => Self::Top(Arc::clone(tables)),
        }
    }
}

impl<B> Clone for Pages<B> {
    fn clone(&self) -> Self {
        Self { root: self.root.clone() }
    }
}

impl<B> Default for Pages<B> {
    fn default() -> Self {
        Self { root: None }
    }
}

fn empty<T>() -> Arc<Table<T>> {
    Arc::new(std::array::from_fn(|_| None))
}

/// A table with one entry, the first.
fn first<T>(entry: Arc<T>) -> Arc<Table<T>> {
    let mut entry = Some(entry);
    Arc::new(std::array::from_fn(|_| entry.take()))
}

/// The tables of the upper and of the lower level, and the place in the latter.
const fn split(index: usize) -> (usize, usize, usize) {
    (index >> (2 * BITS), (index >> BITS) % FANOUT, index % FANOUT)
}

impl<B> Pages<B> {
    /// The table of 32 blocks with that index.
    fn lower(&self, index: usize) -> Option<&Arc<Lower<B>>> {
        match self.root.as_ref()? {
            Root::Lower(table) => (index == 0).then_some(table),
            Root::Upper(table) => table.get(index)?.as_ref(),
            Root::Top(tables) => tables.get(index / FANOUT)?.as_ref()?[index % FANOUT].as_ref(),
        }
    }

    /// One more than the largest index for which `lower` may return a table.
    fn width(&self) -> usize {
        match &self.root {
            None => 0,
            Some(Root::Lower(_)) => 1,
            Some(Root::Upper(_)) => FANOUT,
            Some(Root::Top(tables)) => tables.len() * FANOUT,
        }
    }

    pub(crate) fn get(&self, index: usize) -> Option<&B> {
        self.lower(index / FANOUT)?[index % FANOUT].as_deref()
    }

    /// The indexes at which the two do not share a block.
    pub(crate) fn differing(&self, other: &Self) -> Vec<usize> {
        let block = |table: Option<&Arc<Lower<B>>>, at: usize| Some(Arc::as_ptr(table?[at].as_ref()?));
        let mut found = Vec::new();
        for table in 0..self.width().max(other.width()) {
            let (one, two) = (self.lower(table), other.lower(table));
            if one.map(Arc::as_ptr) != two.map(Arc::as_ptr) {
                let differs = |at: &usize| block(one, *at) != block(two, *at);
                found.extend((0..FANOUT).filter(differs).map(|at| table * FANOUT + at));
            }
        }
        found
    }

    /// All present blocks with their index, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &B)> {
        let tables = (0..self.width()).filter_map(|at| Some((at, self.lower(at)?)));
        tables.flat_map(|(table, blocks)| {
            let blocks = blocks.iter().enumerate();
            blocks.filter_map(move |(at, block)| Some((table * FANOUT + at, block.as_deref()?)))
        })
    }
}

impl<B: Clone> Pages<B> {
    /// The block for writing, not shared with any other copy.
    pub(crate) fn get_mut(&mut self, index: usize) -> Option<&mut B> {
        // Looking for an absent block must not copy the path to it.
        self.get(index)?;
        let (top, middle, low) = split(index);
        let lower = match self.root.as_mut()? {
            Root::Lower(table) => table,
            Root::Upper(table) => Arc::make_mut(table)[middle].as_mut()?,
            Root::Top(tables) => {
                let upper = Arc::make_mut(Arc::make_mut(tables).get_mut(top)?.as_mut()?);
                upper[middle].as_mut()?
            }
        };
        Arc::make_mut(lower)[low].as_mut().map(Arc::make_mut)
    }
}

impl<B: Clone + Default> Pages<B> {
    /// The block for writing, created if it is absent.
    pub(crate) fn make(&mut self, index: usize) -> &mut B {
        let (top, middle, low) = split(index);
        let root = self.root.get_or_insert_with(|| Root::Lower(empty()));
        root.reach(top, middle);
        let lower = match root {
            Root::Lower(table) => table,
            Root::Upper(table) => Arc::make_mut(table)[middle].get_or_insert_with(empty),
            Root::Top(tables) => {
                let upper = Arc::make_mut(tables)[top].get_or_insert_with(empty);
                Arc::make_mut(upper)[middle].get_or_insert_with(empty)
            }
        };
        Arc::make_mut(Arc::make_mut(lower)[low].get_or_insert_with(Arc::default))
    }
}

impl<B> Root<B> {
    /// Grows the tree to the height, and the root to the width, that these tables need.
    fn reach(&mut self, top: usize, middle: usize) {
        if let Self::Lower(table) = self
            && (top, middle) != (0, 0)
        {
            *self = Self::Upper(first(Arc::clone(table)));
        }
        if let Self::Upper(table) = self
            && top > 0
        {
            *self = Self::Top(Arc::new([Some(Arc::clone(table))]));
        }
        if let Self::Top(tables) = self
            && tables.len() <= top
        {
            // The root grows by one table per 1,024 blocks, rarely enough to copy it.
            let more = std::iter::repeat_n(None, top + 1 - tables.len());
            *tables = tables.iter().cloned().chain(more).collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// A copy never sees what is written after it was taken.
        #[test]
        fn copies_are_independent(writes in prop::collection::vec((0_usize..5000, any::<u16>(), any::<bool>()), 0..60)) {
            let (mut pages, mut model) = (Pages::<u16>::default(), BTreeMap::new());
            let mut taken = Vec::new();
            for (index, value, held) in writes {
                if held {
                    taken.push((pages.clone(), model.clone()));
                }
                *pages.make(index) = value;
                model.insert(index, value);
                if let Some(block) = pages.get_mut(index / 2) {
                    *block ^= 1;
                    model.entry(index / 2).and_modify(|value| *value ^= 1);
                }
            }
            taken.push((pages, model));
            for (pages, model) in taken {
                prop_assert!(pages.iter().map(|(index, value)| (index, *value)).eq(model.clone()));
                prop_assert!(model.iter().all(|(&index, value)| pages.get(index) == Some(value)));
                prop_assert!(pages.get(5000).is_none());
            }
        }
    }
}

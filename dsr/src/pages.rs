//! A sparse array of blocks that is written in place, unless somebody else still holds the path to the block.
//!
//! Problem: readers keep old states of a graph with 10^6 nodes while writers go on, and most of the time nobody
//! keeps one. Idea: three levels behind `Arc` over blocks of plain cells. A copy is one reference count; a write
//! asks at each level whether this copy is the only one, and copies that level only if it is not. The tables are
//! narrow (32), because copying a table touches the count of each block below it, and those lie apart.
//! Cost: get is four dependent loads; a write to an array that nobody else holds adds an atomic exchange per
//! level; to a held one, 64 reference counts, the root and one block, once per block and copy.

use std::sync::Arc;

const BITS: u32 = 5;
const FANOUT: usize = 1 << BITS;

type Lower<B> = [Option<Arc<B>>; FANOUT];
type Upper<B> = [Option<Arc<Lower<B>>>; FANOUT];

#[derive(Debug)]
pub(crate) struct Pages<B> {
    root: Arc<[Option<Arc<Upper<B>>>]>,
}

impl<B> Clone for Pages<B> {
    fn clone(&self) -> Self {
        Self { root: Arc::clone(&self.root) }
    }
}

impl<B> Default for Pages<B> {
    fn default() -> Self {
        Self { root: Arc::new([]) }
    }
}

/// A table, or an empty one.
fn table<T>(table: Option<&[Option<Arc<T>>; FANOUT]>) -> &[Option<Arc<T>>] {
    table.map_or(&[], |table| table.as_slice())
}

/// Where two tables do not hold the same.
fn differing<T>(
    one: &[Option<Arc<T>>],
    two: &[Option<Arc<T>>],
    mut look: impl FnMut(usize, Option<&T>, Option<&T>),
) {
    for at in 0..one.len().max(two.len()) {
        let (one, two) = (one.get(at).and_then(Option::as_ref), two.get(at).and_then(Option::as_ref));
        let same = match (one, two) {
            (Some(one), Some(two)) => Arc::ptr_eq(one, two),
            (one, two) => one.is_none() && two.is_none(),
        };
        if !same {
            look(at, one.map(|one| &**one), two.map(|two| &**two));
        }
    }
}

const fn split(index: usize) -> (usize, usize, usize) {
    (index >> (2 * BITS), (index >> BITS) % FANOUT, index % FANOUT)
}

impl<B: Clone> Pages<B> {
    pub(crate) fn get(&self, index: usize) -> Option<&B> {
        let (top, middle, low) = split(index);
        self.root.get(top)?.as_ref()?[middle].as_ref()?[low].as_deref()
    }

    /// The block for writing, alone in this copy.
    pub(crate) fn get_mut(&mut self, index: usize) -> Option<&mut B> {
        // An absent block must not cost a copy of the path to it.
        self.get(index)?;
        let (top, middle, low) = split(index);
        let upper = Arc::make_mut(Arc::make_mut(&mut self.root).get_mut(top)?.as_mut()?);
        let lower = Arc::make_mut(upper[middle].as_mut()?);
        lower[low].as_mut().map(Arc::make_mut)
    }
}

impl<B: Clone + Default> Pages<B> {
    /// The block for writing, made if it is not there.
    pub(crate) fn make(&mut self, index: usize) -> &mut B {
        let (top, middle, low) = split(index);
        if self.root.len() <= top {
            // A table more per 1,024 blocks: growing is rare enough to copy the root.
            let more = std::iter::repeat_n(None, top + 1 - self.root.len());
            self.root = self.root.iter().cloned().chain(more).collect();
        }
        let empty = || Arc::new(std::array::from_fn(|_| None));
        let upper = Arc::make_mut(&mut self.root)[top].get_or_insert_with(empty);
        let empty = || Arc::new(std::array::from_fn(|_| None));
        let lower = Arc::make_mut(upper)[middle].get_or_insert_with(empty);
        Arc::make_mut(Arc::make_mut(lower)[low].get_or_insert_with(Arc::default))
    }
}

impl<B> Pages<B> {
    /// The indexes at which the two do not share a block.
    pub(crate) fn differing(&self, other: &Self) -> Vec<usize> {
        let mut found = Vec::new();
        differing(&self.root, &other.root, |top, one, two| {
            differing(table(one), table(two), |middle, one, two| {
                differing(table(one), table(two), |low, _, _| {
                    found.push(((top << BITS) + middle) * FANOUT + low);
                });
            });
        });
        found
    }

    /// All present blocks with their index, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &B)> {
        let uppers = self.root.iter().enumerate();
        let present = uppers.filter_map(|(at, upper)| Some((at, upper.as_ref()?)));
        let lowers = present.flat_map(|(top, upper)| {
            upper.iter().enumerate().filter_map(move |(at, lower)| Some((top * FANOUT + at, lower.as_ref()?)))
        });
        lowers.flat_map(|(at, lower)| {
            lower
                .iter()
                .enumerate()
                .filter_map(move |(low, block)| Some((at * FANOUT + low, block.as_deref()?)))
        })
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Copies taken on the way never see what was written after them.
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

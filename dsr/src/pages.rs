//! A growable array whose copies share everything that has not been written since.
//!
//! Problem: readers keep old states of a graph with 10^4 and more nodes while writers go on. Idea: three levels
//! of fixed fan-out 32 behind `Arc`; a copy is one reference count, and a write copies the path to its cell,
//! once, and only while somebody else still holds that path. Cost: get is three indexings; a write to a shared
//! array of n cells copies n/1024 + 32 + 32 pointers and one cell; to an unshared one, nothing.

use std::sync::Arc;

const BITS: u32 = 5;
const FANOUT: usize = 1 << BITS;

type Leaf<T> = [Option<Arc<T>>; FANOUT];
type Page<T> = [Option<Arc<Leaf<T>>>; FANOUT];

#[derive(Debug)]
pub(crate) struct Pages<T> {
    root: Arc<Vec<Arc<Page<T>>>>,
}

impl<T> Clone for Pages<T> {
    fn clone(&self) -> Self {
        Self { root: Arc::clone(&self.root) }
    }
}

impl<T> Default for Pages<T> {
    fn default() -> Self {
        Self { root: Arc::default() }
    }
}

const fn split(index: usize) -> (usize, usize, usize) {
    (index >> (2 * BITS), (index >> BITS) % FANOUT, index % FANOUT)
}

impl<T: Clone> Pages<T> {
    pub(crate) fn get(&self, index: usize) -> Option<&Arc<T>> {
        let (page, leaf, cell) = split(index);
        self.root.get(page)?[leaf].as_ref()?[cell].as_ref()
    }

    /// The cell for writing, alone in this copy.
    pub(crate) fn get_mut(&mut self, index: usize) -> Option<&mut T> {
        // An absent cell must not cost a copy of the path to it.
        self.get(index)?;
        let (page, leaf, cell) = split(index);
        let page = Arc::make_mut(Arc::make_mut(&mut self.root).get_mut(page)?);
        let leaf = Arc::make_mut(page[leaf].as_mut()?);
        leaf[cell].as_mut().map(Arc::make_mut)
    }

    pub(crate) fn set(&mut self, index: usize, value: Option<T>) {
        let (page, leaf, cell) = split(index);
        let root = Arc::make_mut(&mut self.root);
        while root.len() <= page {
            root.push(Arc::new(std::array::from_fn(|_| None)));
        }
        let leaf = Arc::make_mut(&mut root[page])[leaf]
            .get_or_insert_with(|| Arc::new(std::array::from_fn(|_| None)));
        Arc::make_mut(leaf)[cell] = value.map(Arc::new);
    }

    /// All present cells with their index, in order.
    pub(crate) fn iter(&self) -> impl Iterator<Item = (usize, &Arc<T>)> {
        let leaves = self.root.iter().flat_map(|page| page.iter()).enumerate();
        leaves.flat_map(|(at, leaf)| {
            leaf.iter()
                .flat_map(|leaf| leaf.iter())
                .enumerate()
                .filter_map(move |(cell, value)| Some((at * FANOUT + cell, value.as_ref()?)))
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
        fn copies_are_independent(writes in prop::collection::vec((0_usize..5000, any::<Option<u16>>()), 0..60)) {
            let (mut pages, mut model) = (Pages::default(), BTreeMap::new());
            let mut taken = Vec::new();
            for (index, value) in writes {
                taken.push((pages.clone(), model.clone()));
                pages.set(index, value);
                model.remove(&index);
                if let Some(value) = value {
                    model.insert(index, value);
                }
            }
            taken.push((pages, model));
            for (pages, model) in taken {
                prop_assert!(pages.iter().map(|(index, value)| (index, **value)).eq(model.clone()));
                prop_assert!(model.iter().all(|(&index, value)| pages.get(index).map(|v| **v) == Some(*value)));
            }
        }
    }
}

//! A priority queue with small integer keys; equal keys are first in, first out.

use std::collections::{BTreeMap, VecDeque};

/// Keys below this have a slot in an array.
const DENSE: usize = 4096;

/// A bucket queue.
pub(crate) struct OpenList<T> {
    dense: Vec<VecDeque<T>>,
    sparse: BTreeMap<u64, VecDeque<T>>,
    lowest: usize,
    len: usize,
}

impl<T> OpenList<T> {
    pub(crate) fn new() -> Self {
        Self { dense: Vec::new(), sparse: BTreeMap::new(), lowest: 0, len: 0 }
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn push(&mut self, key: u64, item: T) {
        self.len += 1;
        match usize::try_from(key) {
            Ok(key) if key < DENSE => {
                if key >= self.dense.len() {
                    self.dense.resize_with(key + 1, VecDeque::new);
                }
                self.dense[key].push_back(item);
                self.lowest = self.lowest.min(key);
            }
            _ => self.sparse.entry(key).or_default().push_back(item),
        }
    }

    /// Finds the first slot that is not empty.
    fn settle(&mut self) -> Option<&mut VecDeque<T>> {
        while self.dense.get(self.lowest).is_some_and(VecDeque::is_empty) {
            self.dense[self.lowest] = VecDeque::new();
            self.lowest += 1;
        }
        self.dense.get_mut(self.lowest)
    }

    /// The item that [`pop`](Self::pop) would return.
    pub(crate) fn first_mut(&mut self) -> Option<&mut T> {
        if self.settle().is_none() {
            return self.sparse.values_mut().next()?.front_mut();
        }
        self.dense[self.lowest].front_mut()
    }

    pub(crate) fn pop(&mut self) -> Option<T> {
        if let Some(slot) = self.settle() {
            let item = slot.pop_front();
            self.len -= 1;
            return item;
        }
        let mut first = self.sparse.first_entry()?;
        let item = first.get_mut().pop_front();
        if first.get().is_empty() {
            first.remove();
        }
        self.len -= 1;
        item
    }

    /// The bytes held by the items.
    pub(crate) fn memory(&self) -> usize {
        self.len * size_of::<T>() * 2
    }
}

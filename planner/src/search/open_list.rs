//! A queue by small integer keys, first in first out among equals.

use std::collections::{BTreeMap, VecDeque};

/// Keys below this have an array slot.
const DENSE: usize = 4096;

/// The queue.
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

    pub(crate) fn pop(&mut self) -> Option<T> {
        while self.lowest < self.dense.len() {
            if let Some(item) = self.dense[self.lowest].pop_front() {
                self.len -= 1;
                return Some(item);
            }
            self.dense[self.lowest] = VecDeque::new();
            self.lowest += 1;
        }
        let mut first = self.sparse.first_entry()?;
        let item = first.get_mut().pop_front();
        if first.get().is_empty() {
            first.remove();
        }
        self.len -= 1;
        item
    }

    /// Bytes held by the items.
    pub(crate) fn memory(&self) -> usize {
        self.len * size_of::<T>() * 2
    }
}

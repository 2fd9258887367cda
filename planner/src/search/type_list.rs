//! A queue without preference: it selects a random type, then a random entry of that type.
//!
//! Problem: if an estimate misleads, a queue sorted by it visits one large plateau before
//! everything else. Idea: entries of the same type share a bucket, and every bucket has the same
//! chance, so rare types of states are visited as often as those with millions of states. The
//! generator is seeded: the same pushes and pops give the same entries.
//!
//! Source: Xie, Müller, Holte & Imai, "Type-based exploration with multiple search queues for
//! satisficing planning", AAAI 2014.

use super::chance::Chance;
use rustc_hash::FxHashMap;

/// The features that the entries of one bucket share.
pub(crate) type Type = [u32; 3];

/// The queue.
pub(crate) struct TypeList<T> {
    index: FxHashMap<Type, usize>,
    buckets: Vec<(Type, Vec<T>)>,
    len: usize,
    chance: Chance,
}

impl<T> TypeList<T> {
    pub(crate) fn new() -> Self {
        Self { index: FxHashMap::default(), buckets: Vec::new(), len: 0, chance: Chance::new(0) }
    }

    pub(crate) fn len(&self) -> usize {
        self.len
    }

    pub(crate) fn push(&mut self, of: Type, items: impl IntoIterator<Item = T>) {
        let mut items = items.into_iter().peekable();
        if items.peek().is_none() {
            return;
        }
        let bucket = *self.index.entry(of).or_insert_with(|| {
            self.buckets.push((of, Vec::new()));
            self.buckets.len() - 1
        });
        let bucket = &mut self.buckets[bucket].1;
        let before = bucket.len();
        bucket.extend(items);
        self.len += bucket.len() - before;
    }

    pub(crate) fn pop(&mut self) -> Option<T> {
        if self.buckets.is_empty() {
            return None;
        }
        let at = self.chance.below(self.buckets.len());
        let entry = self.chance.below(self.buckets[at].1.len());
        let item = self.buckets[at].1.swap_remove(entry);
        self.len -= 1;
        if self.buckets[at].1.is_empty() {
            let (gone, _) = self.buckets.swap_remove(at);
            self.index.remove(&gone);
            if let Some((moved, _)) = self.buckets.get(at) {
                self.index.insert(*moved, at);
            }
        }
        Some(item)
    }

    /// The bytes held by the items.
    pub(crate) fn memory(&self) -> usize {
        self.len * size_of::<T>() * 2 + self.buckets.len() * 96
    }
}

#[cfg(test)]
mod tests {
    use super::TypeList;

    #[test]
    fn all_that_was_pushed_comes_back_and_rare_types_come_early() {
        let mut list = TypeList::new();
        list.push([0, 0, 0], 0..1000);
        list.push([1, 0, 0], [1000]);
        list.push([2, 0, 0], []);
        let all: Vec<i32> = std::iter::from_fn(|| list.pop()).collect();
        let mut sorted = all.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (0..=1000).collect::<Vec<_>>());
        assert_eq!((list.len(), list.pop()), (0, None));
        let rare = all.iter().position(|&i| i == 1000);
        assert!(rare < Some(64), "half a chance each time");
    }
}

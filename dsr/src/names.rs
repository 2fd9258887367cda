//! Names of nodes: from id to name and back, in copies that share what has not been written since.
//!
//! Problem: one hash map of 10^6 names is copied as a whole for a snapshot, and stalls a write while it grows. Idea:
//! linear hashing. The buckets are blocks of [`Pages`]; each insertion above the load splits at most one bucket, so the
//! table grows without a pause and a write copies one bucket. A bucket holds hashes and ids. The name itself is stored
//! with the id, and is compared only when the hash agrees. The hash is fixed (no random state), and no code iterates
//! over the buckets.
//!
//! Source: Litwin, "Linear hashing: a new tool for file and table addressing", VLDB 1980.

use std::hash::{BuildHasher, BuildHasherDefault};
use std::sync::Arc;

use rustc_hash::FxHasher;

use crate::block::{NODES, place};
use crate::id::NodeId;
use crate::pages::Pages;

/// The mean number of names per bucket above which a bucket is split.
const LOAD: usize = 12;

#[derive(Debug, Clone)]
pub(crate) struct Names {
    texts: Pages<[Option<Arc<str>>; NODES]>,
    buckets: Pages<Vec<(u32, NodeId)>>,
    /// The number of buckets; at least one.
    count: usize,
    len: usize,
}

impl Default for Names {
    fn default() -> Self {
        Self { texts: Pages::default(), buckets: Pages::default(), count: 1, len: 0 }
    }
}

fn hash_of(name: &str) -> u32 {
    let hash = BuildHasherDefault::<FxHasher>::default().hash_one(name);
    u32::try_from((hash ^ (hash >> 32)) & u64::from(u32::MAX)).expect("32 bits")
}

/// The bucket of a hash among `count` buckets: its bucket among the next power of two, or, if that one has not been
/// split off yet, the bucket that will be split into it.
fn bucket_of(hash: u32, count: usize) -> usize {
    let mask = count.next_power_of_two() - 1;
    let bucket = hash as usize & mask;
    if bucket < count { bucket } else { bucket & (mask >> 1) }
}

impl Names {
    /// The node of that name.
    pub(crate) fn get(&self, name: &str) -> Option<NodeId> {
        let hash = hash_of(name);
        let bucket = self.buckets.get(bucket_of(hash, self.count))?;
        let same = |id: NodeId| self.of(id).is_some_and(|found| **found == *name);
        bucket.iter().find(|(other, id)| *other == hash && same(*id)).map(|(_, id)| *id)
    }

    /// The name of a node.
    pub(crate) fn of(&self, id: NodeId) -> Option<&Arc<str>> {
        let (block, slot) = place(id);
        self.texts.get(block)?[slot].as_ref()
    }

    pub(crate) fn insert(&mut self, name: Arc<str>, id: NodeId) {
        let hash = hash_of(&name);
        let (block, slot) = place(id);
        self.texts.make(block)[slot] = Some(name);
        self.buckets.make(bucket_of(hash, self.count)).push((hash, id));
        self.len += 1;
        if self.len > self.count * LOAD {
            self.split();
        }
    }

    /// Removes the name of a node.
    pub(crate) fn remove(&mut self, id: NodeId) -> Option<Arc<str>> {
        let (block, slot) = place(id);
        let name = self.texts.get_mut(block)?[slot].take()?;
        if let Some(bucket) = self.buckets.get_mut(bucket_of(hash_of(&name), self.count))
            && let Some(at) = bucket.iter().position(|(_, other)| *other == id)
        {
            bucket.swap_remove(at);
            self.len -= 1;
        }
        Some(name)
    }

    /// Splits one bucket into two.
    fn split(&mut self) {
        let new = self.count;
        let old = new & !(1 << new.ilog2());
        self.count += 1;
        let entries = std::mem::take(self.buckets.make(old));
        let (stay, go) = entries.into_iter().partition(|(hash, _)| bucket_of(*hash, self.count) == old);
        *self.buckets.make(old) = stay;
        *self.buckets.make(new) = go;
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn agrees_with_a_map(writes in prop::collection::vec((0_u32..400, any::<bool>()), 0..800)) {
            let (mut names, mut model) = (Names::default(), BTreeMap::new());
            let mut held = None;
            for (at, (id, comes)) in writes.into_iter().enumerate() {
                if at == 300 {
                    held = Some((names.clone(), model.clone()));
                }
                let (id, name) = (NodeId(id), format!("n{id}"));
                let there = model.remove(&name);
                prop_assert_eq!(names.remove(id).is_some(), there.is_some());
                if comes {
                    names.insert(name.as_str().into(), id);
                    model.insert(name, id);
                }
            }
            for (names, model) in held.into_iter().chain([(names, model)]) {
                for id in 0..400 {
                    let name = format!("n{id}");
                    prop_assert_eq!(names.get(&name), model.get(&name).copied());
                    prop_assert_eq!(names.of(NodeId(id)).is_some(), model.contains_key(&name));
                }
            }
        }
    }
}

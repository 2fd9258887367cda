//! Names of nodes: a map from name to id whose copies share what has not been written since.
//!
//! Idea: 256 small maps by hash, each behind an `Arc`, so that adding a node while a snapshot is held copies one
//! two-hundred-and-fifty-sixth of the names. The hash is fixed (no random state), and nothing iterates over it.

use std::hash::{BuildHasher, BuildHasherDefault};
use std::sync::Arc;

use rustc_hash::{FxHashMap, FxHasher};

use crate::id::NodeId;

const SHARDS: usize = 256;

type Shard = Arc<FxHashMap<Arc<str>, NodeId>>;

#[derive(Debug, Clone)]
pub(crate) struct Names {
    shards: Arc<Vec<Shard>>,
}

impl Default for Names {
    fn default() -> Self {
        Self { shards: Arc::new(vec![Shard::default(); SHARDS]) }
    }
}

fn shard_of(name: &str) -> usize {
    // The top bits, because the map inside the shard uses the low ones.
    (BuildHasherDefault::<FxHasher>::default().hash_one(name) >> 56) as usize % SHARDS
}

impl Names {
    pub(crate) fn get(&self, name: &str) -> Option<NodeId> {
        self.shards[shard_of(name)].get(name).copied()
    }

    pub(crate) fn insert(&mut self, name: Arc<str>, id: NodeId) {
        let shard = shard_of(&name);
        Arc::make_mut(&mut Arc::make_mut(&mut self.shards)[shard]).insert(name, id);
    }

    pub(crate) fn remove(&mut self, name: &str) {
        Arc::make_mut(&mut Arc::make_mut(&mut self.shards)[shard_of(name)]).remove(name);
    }
}

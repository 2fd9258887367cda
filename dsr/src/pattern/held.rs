//! The matches that a subscriber has, indexed by each of their nodes.

use std::collections::BTreeSet;

use rustc_hash::FxHashMap;

use super::compiled::{Binding, Pattern};
use crate::id::NodeId;

/// The matches that a subscriber has.
pub(crate) struct Held {
    all: BTreeSet<Binding>,
    /// For each variable, the matches by its node.
    by_node: Vec<FxHashMap<NodeId, BTreeSet<Binding>>>,
}

impl Held {
    pub(crate) fn new(pattern: &Pattern) -> Self {
        Self { all: BTreeSet::new(), by_node: pattern.variables().map(|_| FxHashMap::default()).collect() }
    }

    pub(crate) fn all(&self) -> &BTreeSet<Binding> {
        &self.all
    }

    /// The matches with these nodes.
    pub(crate) fn with<'h>(&'h self, fixed: &'h [(usize, NodeId)]) -> impl Iterator<Item = &'h Binding> {
        let sets = fixed.iter().map(|(at, node)| self.by_node[*at].get(node));
        // Search the smallest of the sets; if one of them is empty, there is no match.
        let smallest = sets.min_by_key(|set| set.map_or(0, BTreeSet::len));
        let among = smallest.unwrap_or(Some(&self.all)).into_iter().flatten();
        among.filter(|binding| fixed.iter().all(|(at, node)| binding[*at] == *node))
    }

    pub(crate) fn find(&mut self, binding: &Binding) {
        for (sets, node) in self.by_node.iter_mut().zip(binding.iter()) {
            sets.entry(*node).or_default().insert(binding.clone());
        }
        self.all.insert(binding.clone());
    }

    pub(crate) fn lose(&mut self, binding: &Binding) {
        for (sets, node) in self.by_node.iter_mut().zip(binding.iter()) {
            if let Some(set) = sets.get_mut(node) {
                set.remove(binding);
                if set.is_empty() {
                    sets.remove(node);
                }
            }
        }
        self.all.remove(binding);
    }
}

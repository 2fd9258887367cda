//! What holds in the present state: the matches of every condition, and the nodes of every type that is quantified over.
//!
//! Invariant: after each report of a subscription to [`interest`](Facts::interest), the facts are those of the state that
//! it reports. Cost: linear in the matches that changed.

use crate::formula::{Condition, ConditionId, Formula};
use dsr::{Binding, Interest, Mentions, News, NodeId, Snapshot, TypeId};
use rustc_hash::{FxHashMap, FxHashSet};
use smallvec::SmallVec;
use std::sync::Arc;

/// The nodes for the variables of a condition, in its order.
pub(crate) type Key = SmallVec<[NodeId; 4]>;

/// The facts of the present state.
pub(crate) struct Facts {
    /// For each pattern of the interest, its condition and how many variables that has.
    conditions: Vec<(ConditionId, usize)>,
    /// For each condition, how many matches its patterns have for each key.
    holding: Vec<FxHashMap<Key, u32>>,
    /// For each type that is quantified over, its nodes by id.
    nodes: FxHashMap<TypeId, Vec<NodeId>>,
    names: FxHashMap<NodeId, Arc<str>>,
}

impl Facts {
    pub(crate) fn new(conditions: &[Condition], formulas: &[Formula]) -> Self {
        let patterns = |(at, condition): (usize, &Condition)| {
            let id = ConditionId(u32::try_from(at).expect("compiled as such"));
            std::iter::repeat_n((id, condition.variables), condition.patterns.len())
        };
        let types = formulas.iter().flat_map(|f| &f.variables).flat_map(|(_, types)| types);
        Self {
            conditions: conditions.iter().enumerate().flat_map(patterns).collect(),
            holding: vec![FxHashMap::default(); conditions.len()],
            nodes: types.map(|&ty| (ty, Vec::new())).collect(),
            names: FxHashMap::default(),
        }
    }

    /// What a subscription must report.
    pub(crate) fn interest(conditions: &[Condition], formulas: &[Formula], snapshot: &Snapshot) -> Interest {
        let mut interest = Interest::default();
        for pattern in conditions.iter().flat_map(|condition| &condition.patterns) {
            interest.add(Arc::clone(pattern));
        }
        let mut mentions = Mentions::default();
        let vocabulary = snapshot.vocabulary();
        for &quantified in formulas.iter().flat_map(|f| &f.variables).flat_map(|(_, types)| types) {
            let subtypes = vocabulary.types().filter(|&ty| vocabulary.is_a(ty, quantified));
            subtypes.for_each(|ty| mentions.add_type(ty));
        }
        interest.add_tokens(&mentions);
        interest
    }

    /// Takes over a report. Returns whether nodes came or went, and the conditions whose truth changed, with their keys.
    pub(crate) fn update(&mut self, news: &News) -> (bool, Vec<(ConditionId, Key)>) {
        let nodes = self.update_nodes(news);
        let mut changed = Vec::new();
        for change in &news.matches {
            let (condition, variables) = self.conditions[change.pattern.index()];
            let key = |binding: &Binding| Key::from_slice(&binding[..variables]);
            let holding = &mut self.holding[condition.0 as usize];
            for binding in &change.appeared {
                let count = holding.entry(key(binding)).or_default();
                *count += 1;
                if *count == 1 {
                    changed.push((condition, key(binding)));
                }
            }
            for binding in &change.disappeared {
                let key = key(binding);
                let left = holding.get_mut(&key).map(|count| {
                    *count = count.saturating_sub(1);
                    *count
                });
                if left == Some(0) {
                    holding.remove(&key);
                    changed.push((condition, key));
                }
            }
        }
        (nodes, changed)
    }

    fn update_nodes(&mut self, news: &News) -> bool {
        let moved = |change: &dsr::Change| {
            matches!(change, dsr::Change::NodeAdded { .. } | dsr::Change::NodeRemoved { .. })
        };
        let begins = news.deltas.is_empty();
        if !begins && !news.deltas.iter().flat_map(|delta| &delta.changes).any(moved) {
            return false;
        }
        let snapshot = &news.snapshot;
        for (&ty, nodes) in &mut self.nodes {
            *nodes = snapshot.nodes_of(ty).collect();
            nodes.sort_unstable();
            for &node in nodes.iter() {
                let name = || Arc::from(snapshot.name(node).unwrap_or_default());
                self.names.entry(node).or_insert_with(name);
            }
        }
        true
    }

    pub(crate) fn holds(&self, condition: ConditionId, key: &Key) -> bool {
        self.holding[condition.0 as usize].contains_key(key)
    }

    /// The nodes of these types, each once.
    pub(crate) fn nodes_of(&self, types: &[TypeId]) -> Vec<NodeId> {
        if let [only] = types {
            return self.nodes.get(only).cloned().unwrap_or_default();
        }
        let mut seen = FxHashSet::default();
        let all = types.iter().filter_map(|ty| self.nodes.get(ty)).flatten();
        all.copied().filter(|&node| seen.insert(node)).collect()
    }

    /// The name of a node that a variable has stood for, even if it is no longer there.
    pub(crate) fn name(&self, node: NodeId) -> &str {
        self.names.get(&node).map_or("", |name| name)
    }
}

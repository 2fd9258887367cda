//! The derived facts: the heads that each axiom gives, and how many axioms give each fact of a predicate.
//!
//! The sets are sorted, so that an explanation finds the same witness every time.

use std::collections::{BTreeMap, BTreeSet};

use dsr::NodeId;
use pddl::model::{Idx, PredicateId};

/// The arguments of a fact.
pub(crate) type Tuple = Vec<NodeId>;

/// A head of which some parameters are fixed; an empty slot fits any node.
pub(crate) type Partial = Vec<Option<NodeId>>;

/// Whether a tuple has the fixed nodes.
pub(crate) fn agrees(tuple: &[NodeId], partial: &[Option<NodeId>]) -> bool {
    tuple.iter().zip(partial).all(|(node, fixed)| fixed.is_none_or(|fixed| fixed == *node))
}

/// The nodes that are fixed before the first slot that is not. Tuples are sorted, so those that begin with them are a
/// range.
fn prefix(fixed: &[Option<NodeId>]) -> Tuple {
    fixed.iter().map_while(|node| *node).collect()
}

/// All derived facts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Relations {
    by_axiom: Vec<BTreeSet<Tuple>>,
    /// By predicate: the number of axioms that give the tuple, never 0.
    support: Vec<BTreeMap<Tuple, u32>>,
}

impl Relations {
    pub(crate) fn new(axioms: usize, predicates: usize) -> Self {
        Self { by_axiom: vec![BTreeSet::new(); axioms], support: vec![BTreeMap::new(); predicates] }
    }

    pub(crate) fn contains(&self, predicate: PredicateId, tuple: &[NodeId]) -> bool {
        self.support[predicate.index()].contains_key(tuple)
    }

    /// The tuples of a predicate that have the fixed nodes, in order.
    pub(crate) fn matching<'a>(
        &'a self,
        predicate: PredicateId,
        fixed: &'a [Option<NodeId>],
    ) -> impl Iterator<Item = &'a Tuple> {
        let prefix = prefix(fixed);
        self.support[predicate.index()]
            .range(prefix.clone()..)
            .map(|(tuple, _)| tuple)
            .take_while(move |tuple| tuple.starts_with(&prefix))
            .filter(|tuple| agrees(tuple, fixed))
    }

    /// How many tuples of a predicate begin with these nodes.
    pub(crate) fn beginning_with(&self, predicate: PredicateId, prefix: &[NodeId]) -> f64 {
        let from = self.support[predicate.index()].range(prefix.to_vec()..);
        let count = from.take_while(|(tuple, _)| tuple.starts_with(prefix)).count();
        f64::from(u32::try_from(count).unwrap_or(u32::MAX))
    }

    /// The heads of an axiom that have the fixed nodes.
    pub(crate) fn heads(&self, axiom: usize, fixed: &[Option<NodeId>]) -> Vec<Tuple> {
        let prefix = prefix(fixed);
        let heads = self.by_axiom[axiom].range(prefix.clone()..);
        let heads = heads.take_while(|tuple| tuple.starts_with(&prefix));
        heads.filter(|tuple| agrees(tuple, fixed)).cloned().collect()
    }

    /// Whether the axiom gives the tuple.
    pub(crate) fn gives(&self, axiom: usize, tuple: &[NodeId]) -> bool {
        self.by_axiom[axiom].contains(tuple)
    }

    /// Adds a tuple to an axiom. Returns whether it is new there.
    pub(crate) fn insert(&mut self, axiom: usize, predicate: PredicateId, tuple: &Tuple) -> bool {
        let new = self.by_axiom[axiom].insert(tuple.clone());
        if new {
            *self.support[predicate.index()].entry(tuple.clone()).or_insert(0) += 1;
        }
        new
    }

    /// Removes a tuple from an axiom.
    pub(crate) fn remove(&mut self, axiom: usize, predicate: PredicateId, tuple: &Tuple) {
        if !self.by_axiom[axiom].remove(tuple) {
            return;
        }
        let support = &mut self.support[predicate.index()];
        match support.get_mut(tuple) {
            Some(count) if *count > 1 => *count -= 1,
            _ => {
                support.remove(tuple);
            }
        }
    }

    /// All tuples of a predicate.
    pub(crate) fn tuples(&self, predicate: PredicateId) -> impl Iterator<Item = &Tuple> {
        self.support[predicate.index()].keys()
    }
}

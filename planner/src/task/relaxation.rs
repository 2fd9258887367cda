//! The delete relaxation as flat arrays.
//!
//! Problem: heuristics visit the same bipartite graph of propositions and operators millions of
//! times. Idea: there is a proposition for each fact, and for the negation of each fact that some
//! condition negates. There is a node for each operator, each of its conditional effects and each
//! axiom rule. Adjacency is in compressed rows. Deleting a fact achieves its negation. The negation
//! of a derived fact counts as true (optimistic, hence safe). A comparison of numbers is a fact
//! like others; [`Ways`] holds how often an operator must be repeated for it. Invariant: a plan of
//! the task is a plan of the relaxation.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §3; negations as in Helmert 2006.

use super::literals::Literals;
use super::repetition::Ways;
use super::rows::Rows;
use super::state::{contains, for_each_set};
use crate::ids::{FactId, id32};
use pddl::model::Idx;

/// The operator number of an axiom's node.
pub(crate) const AXIOM: u32 = u32::MAX;

/// The graph.
#[derive(Clone, Debug, Default)]
pub(crate) struct Relaxation {
    pub(super) facts: usize,
    /// Facts with a proposition for their negation, in order of these propositions.
    pub(super) negated: Vec<FactId>,
    /// The proposition for the negation of a fact, or 0 (no negation is proposition 0).
    pub(super) negation: Vec<u32>,
    /// Negations of derived facts.
    pub(super) optimistic: Vec<u32>,
    /// The operator of each node, or [`AXIOM`].
    pub(crate) operator: Vec<u32>,
    /// The cost of each node.
    pub(crate) cost: Vec<u32>,
    /// The preconditions of each node.
    pub(crate) preconditions: Rows,
    /// The propositions that each node achieves.
    pub(crate) effects: Rows,
    /// How each node achieves its propositions.
    pub(crate) ways: Ways,
    /// The nodes that need each proposition.
    pub(crate) needed_by: Rows,
    /// The first move; all nodes from this one on have exactly one precondition.
    pub(crate) first_move: u32,
    /// By proposition: where the moves begin in its row of `needed_by`.
    pub(super) moves_at: Vec<u32>,
    /// By proposition: its clique.
    pub(crate) clique: Vec<u32>,
    pub(crate) cliques: usize,
    /// The nodes without preconditions.
    pub(crate) free: Vec<u32>,
}

impl Relaxation {
    /// The nodes that need a proposition: first those that are not moves, then the moves.
    pub(crate) fn waiting_and_moves(&self, proposition: u32) -> (&[u32], &[u32]) {
        self.needed_by.row(proposition).split_at(self.moves_at[proposition as usize] as usize)
    }

    /// The price of a node: whether it is an operator, then its cost.
    pub(crate) fn price(&self, node: u32) -> (bool, u32) {
        (self.operator[node as usize] != AXIOM, self.cost[node as usize])
    }

    /// The propositions of a conjunction. A negated fact without a proposition (of a goal that is
    /// newer than the grounding) is left out: optimistic.
    pub(crate) fn literals(&self, literals: &Literals) -> Vec<u32> {
        let negative = literals.negative.iter().map(|f| self.negation[f.index()]).filter(|&p| p != 0);
        literals.positive.iter().map(|f| f.0).chain(negative).collect()
    }

    /// The number of propositions.
    pub(crate) fn propositions(&self) -> usize {
        self.facts + self.negated.len()
    }

    /// The approximate bytes that it holds.
    pub(crate) fn memory_bytes(&self) -> usize {
        let rows = [&self.preconditions, &self.effects, &self.needed_by];
        let lists = self.operator.capacity() + self.cost.capacity() + self.free.capacity() + self.facts;
        rows.into_iter().map(Rows::memory_bytes).sum::<usize>() + lists * size_of::<u32>()
    }

    /// The number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.operator.len()
    }

    /// The fact of a proposition and whether it must hold.
    pub(crate) fn literal(&self, proposition: u32) -> (FactId, bool) {
        match (proposition as usize).checked_sub(self.facts) {
            None => (FactId(proposition), true),
            Some(i) => (self.negated[i], false),
        }
    }

    /// Calls `f` with every proposition that is true in the state.
    pub(crate) fn for_each_true(&self, words: &[u64], mut f: impl FnMut(u32)) {
        for_each_set(&words[..self.facts.div_ceil(64)], &mut f);
        for (i, &fact) in self.negated.iter().enumerate() {
            if !contains(words, fact) {
                f(id32(self.facts + i));
            }
        }
        for &proposition in &self.optimistic {
            f(proposition);
        }
    }
}

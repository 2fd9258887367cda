//! Which operators are applicable?
//!
//! Problem: testing every operator in every state is far too slow. Idea: a trie over the literals of
//! preconditions, frequent facts first, so that one failed test rules out a whole branch. Invariant:
//! each operator sits at the node that its sorted precondition spells. Cost: one bit test per child
//! of each node that is reached.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, §5.3.1. We branch on literals
//! and not on variables with many values.

use super::{Operator, contains};
use crate::ids::{FactId, OperatorId, id32};
use pddl::model::{Idx, IndexVec};

#[derive(Clone, Debug)]
struct Node {
    /// The tested literal: `fact << 1 | negated`.
    literal: u32,
    /// One past the last node of this branch.
    skip_to: u32,
    /// Operators of this node, a range of `operators`.
    first: u32,
    last: u32,
}

/// The trie, in depth-first order.
#[derive(Clone, Debug, Default)]
pub(crate) struct SuccessorTree {
    nodes: Vec<Node>,
    operators: Vec<OperatorId>,
    /// Operators without precondition are the first ones.
    unconditional: usize,
}

impl SuccessorTree {
    pub(crate) fn new(facts: usize, operators: &IndexVec<OperatorId, Operator>) -> Self {
        let mut frequency = vec![0_u32; facts];
        for op in operators {
            for f in &op.precondition.positive {
                frequency[f.index()] += 1;
            }
        }
        let mut keyed: Vec<(Vec<u32>, OperatorId)> = operators
            .enumerate()
            .map(|(id, op)| {
                let mut facts: Vec<FactId> = op.precondition.positive.to_vec();
                facts.sort_by_key(|f| (std::cmp::Reverse(frequency[f.index()]), f.0));
                let positive = facts.iter().map(|f| f.0 << 1);
                (positive.chain(op.precondition.negative.iter().map(|f| f.0 << 1 | 1)).collect(), id)
            })
            .collect();
        keyed.sort_unstable();
        let unconditional = keyed.partition_point(|(k, _)| k.is_empty());
        let mut tree = Self { unconditional, ..Self::default() };
        tree.operators.extend(keyed[..tree.unconditional].iter().map(|(_, id)| *id));
        tree.build(&keyed[tree.unconditional..], 0);
        tree
    }

    /// Appends the nodes for `keyed`, whose keys agree up to `depth` and are longer than it.
    fn build(&mut self, keyed: &[(Vec<u32>, OperatorId)], depth: usize) {
        let mut rest = keyed;
        while let Some((key, _)) = rest.first() {
            let literal = key[depth];
            let (branch, others) = rest.split_at(rest.partition_point(|(k, _)| k[depth] == literal));
            let ends = branch.partition_point(|(k, _)| k.len() == depth + 1);
            let node = self.nodes.len();
            let first = id32(self.operators.len());
            self.operators.extend(branch[..ends].iter().map(|(_, id)| *id));
            self.nodes.push(Node { literal, skip_to: 0, first, last: id32(self.operators.len()) });
            self.build(&branch[ends..], depth + 1);
            self.nodes[node].skip_to = id32(self.nodes.len());
            rest = others;
        }
    }

    /// Appends every applicable operator to `found`.
    pub(crate) fn applicable(&self, words: &[u64], found: &mut Vec<OperatorId>) {
        found.extend_from_slice(&self.operators[..self.unconditional]);
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if contains(words, FactId(node.literal >> 1)) == (node.literal & 1 == 0) {
                found.extend_from_slice(&self.operators[node.first as usize..node.last as usize]);
                at += 1;
            } else {
                at = node.skip_to as usize;
            }
        }
    }
}

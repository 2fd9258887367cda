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

/// The literals of each operator's precondition, frequent facts first, behind each other.
struct Keys {
    starts: Vec<u32>,
    literals: Vec<u32>,
}

impl Default for Keys {
    fn default() -> Self {
        Self { starts: vec![0], literals: Vec::new() }
    }
}

impl Keys {
    fn of(&self, operator: u32) -> &[u32] {
        let i = operator as usize;
        &self.literals[self.starts[i] as usize..self.starts[i + 1] as usize]
    }

    /// The first two literals as a number that compares as they do; a missing one is 0.
    fn prefix(&self, operator: u32) -> u64 {
        let key = self.of(operator);
        let part = |i: usize| key.get(i).map_or(0, |&l| u64::from(l) + 1);
        part(0) << 32 | part(1)
    }
}

/// How many of the first items pass, if those that pass come first: small answers are found at once.
fn gallop(items: &[u32], pass: impl Fn(u32) -> bool) -> usize {
    let mut step = 1;
    while step < items.len() && pass(items[step - 1]) {
        step *= 2;
    }
    let from = step / 2;
    from + items[from..items.len().min(step)].partition_point(|&i| pass(i))
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
        let mut keys = Keys::default();
        for op in operators {
            let start = keys.literals.len();
            keys.literals.extend(op.precondition.positive.iter().map(|f| f.0 << 1));
            keys.literals[start..]
                .sort_unstable_by_key(|&l| (std::cmp::Reverse(frequency[l as usize / 2]), l));
            keys.literals.extend(op.precondition.negative.iter().map(|f| f.0 << 1 | 1));
            keys.starts.push(id32(keys.literals.len()));
        }
        let mut sorted: Vec<(u64, u32)> = (0..id32(operators.len())).map(|i| (keys.prefix(i), i)).collect();
        sorted.sort_unstable_by(|a, b| {
            a.0.cmp(&b.0).then_with(|| keys.of(a.1).cmp(keys.of(b.1))).then(a.1.cmp(&b.1))
        });
        let sorted: Vec<u32> = sorted.into_iter().map(|(_, i)| i).collect();
        let unconditional = sorted.partition_point(|&i| keys.of(i).is_empty());
        let mut tree = Self { unconditional, ..Self::default() };
        tree.operators.extend(sorted.iter().map(|&i| OperatorId(i)));
        tree.build(&keys, &sorted, unconditional..sorted.len(), 0);
        tree
    }

    /// Appends the nodes for a range of the sorted operators, whose keys agree up to `depth` and are
    /// longer than it. The operators of a branch lie together in that order, those of its node first.
    fn build(&mut self, keys: &Keys, sorted: &[u32], range: std::ops::Range<usize>, depth: usize) {
        let mut at = range.start;
        while at < range.end {
            let literal = keys.of(sorted[at])[depth];
            let branch = at + gallop(&sorted[at..range.end], |i| keys.of(i)[depth] == literal);
            let ends = at + gallop(&sorted[at..branch], |i| keys.of(i).len() == depth + 1);
            let node = self.nodes.len();
            self.nodes.push(Node { literal, skip_to: 0, first: id32(at), last: id32(ends) });
            self.build(keys, sorted, ends..branch, depth + 1);
            self.nodes[node].skip_to = id32(self.nodes.len());
            at = branch;
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

//! Finds the applicable operators of a state.
//!
//! Problem: testing every operator in every state is far too slow. Idea: a trie over the literals
//! of preconditions, frequent facts first, so one failed test rules out a whole branch. Invariant:
//! each operator is at the node that its sorted precondition spells. Cost: one bit test per child
//! of each visited node.
//!
//! Source: Helmert, "The Fast Downward planning system", JAIR 2006, §5.3.1. We branch on literals
//! instead of multi-valued variables.

use super::{Operators, contains};
use crate::ids::{FactId, OperatorId, id32};
use budget::{Interrupted, Meter};
use pddl::model::Idx;

#[derive(Clone, Debug)]
struct Node {
    /// The tested literal: `fact << 1 | negated`.
    literal: u32,
    /// One past the last node of this branch.
    skip_to: u32,
    /// The operators of this node: a range of `operators`.
    first: u32,
    last: u32,
}

/// A range of sorted operators whose keys agree up to the node and continue below it.
struct Branch {
    node: Option<usize>,
    at: usize,
    end: usize,
}

/// Up to this many operators are sorted by comparison, more by counting.
const FEW: usize = 1 << 10;

/// The literals of each operator's precondition, frequent facts first, in one vector.
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

    /// The sort key of an operator at a depth; the end of its literals sorts first.
    fn symbol(&self, operator: u32, depth: usize) -> u32 {
        self.of(operator).get(depth).map_or(0, |&l| l + 1)
    }
}

/// Sorts operators by their keys. Counts one literal after the other, so that the meter can
/// interrupt the sorting of a million operators.
struct Sorter<'k> {
    keys: &'k Keys,
    meter: &'k Meter<'k>,
    counts: Vec<u32>,
    sorted: Vec<u32>,
}

impl Sorter<'_> {
    /// Sorts operators whose keys agree up to `depth`.
    fn sort(&mut self, items: &mut [u32], depth: usize) -> Result<(), Interrupted> {
        let keys = self.keys;
        self.meter.spend(64 * items.len().min(FEW))?;
        if items.len() <= FEW {
            let rest = |i: u32| keys.of(i).get(depth..).unwrap_or(&[]);
            items.sort_unstable_by(|&a, &b| rest(a).cmp(rest(b)).then(a.cmp(&b)));
            return Ok(());
        }
        self.counts.fill(0);
        self.meter.spend(self.counts.len() / 4)?;
        for part in self.meter.chunks(items, 8) {
            part?.iter().for_each(|&i| self.counts[keys.symbol(i, depth) as usize + 1] += 1);
        }
        for i in 1..self.counts.len() {
            self.counts[i] += self.counts[i - 1];
        }
        for part in self.meter.chunks(items, 8) {
            for &i in part? {
                let place = &mut self.counts[keys.symbol(i, depth) as usize];
                self.sorted[*place as usize] = i;
                *place += 1;
            }
        }
        items.copy_from_slice(&self.sorted[..items.len()]);
        let mut at = 0;
        while at < items.len() {
            let symbol = keys.symbol(items[at], depth);
            let end = at + gallop(&items[at..], |i| keys.symbol(i, depth) == symbol);
            if symbol > 0 {
                self.sort(&mut items[at..end], depth + 1)?;
            }
            at = end;
        }
        Ok(())
    }
}

/// The number of leading items that pass, if those that pass come first; a small result is found
/// quickly.
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
    /// The number of operators without precondition, which come first.
    unconditional: usize,
}

impl SuccessorTree {
    pub(crate) fn new(facts: usize, operators: &Operators, meter: &Meter<'_>) -> Result<Self, Interrupted> {
        let mut frequency = vec![0_u32; facts];
        for op in operators.iter() {
            meter.spend(8 + op.precondition.positive.len())?;
            for f in op.precondition.positive {
                frequency[f.index()] += 1;
            }
        }
        let mut keys = Keys::default();
        for op in operators.iter() {
            meter.spend(16 + 8 * op.precondition.len())?;
            let start = keys.literals.len();
            keys.literals.extend(op.precondition.positive.iter().map(|f| f.0 << 1));
            keys.literals[start..]
                .sort_unstable_by_key(|&l| (std::cmp::Reverse(frequency[l as usize / 2]), l));
            keys.literals.extend(op.precondition.negative.iter().map(|f| f.0 << 1 | 1));
            keys.starts.push(id32(keys.literals.len()));
        }
        let mut sorted: Vec<u32> = (0..id32(operators.len())).collect();
        let (counts, buffer) = match sorted.len() {
            0..=FEW => (Vec::new(), Vec::new()),
            many => (vec![0; 2 * facts + 2], vec![0; many]),
        };
        Sorter { keys: &keys, meter, counts, sorted: buffer }.sort(&mut sorted, 0)?;
        let unconditional = sorted.partition_point(|&i| keys.of(i).is_empty());
        let mut tree = Self { unconditional, ..Self::default() };
        tree.build(&keys, &sorted, meter)?;
        tree.operators = sorted.into_iter().map(OperatorId).collect();
        Ok(tree)
    }

    /// Appends the nodes. The operators of a branch are adjacent in the sorted order, those of its
    /// own node first. (Not recursive, because a precondition may contain every fact.)
    fn build(&mut self, keys: &Keys, sorted: &[u32], meter: &Meter<'_>) -> Result<(), Interrupted> {
        let mut open = vec![Branch { node: None, at: self.unconditional, end: sorted.len() }];
        while let Some(depth) = open.len().checked_sub(1) {
            let Branch { node, at, end } = &mut open[depth];
            if at == end {
                if let Some(node) = *node {
                    self.nodes[node].skip_to = id32(self.nodes.len());
                }
                open.pop();
                continue;
            }
            meter.spend(32)?;
            let literal = keys.of(sorted[*at])[depth];
            let branch = *at + gallop(&sorted[*at..*end], |i| keys.of(i)[depth] == literal);
            let ends = *at + gallop(&sorted[*at..branch], |i| keys.of(i).len() == depth + 1);
            let new = Branch { node: Some(self.nodes.len()), at: ends, end: branch };
            self.nodes.push(Node { literal, skip_to: 0, first: id32(*at), last: id32(ends) });
            *at = branch;
            open.push(new);
        }
        Ok(())
    }

    /// The bytes that it holds.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.operators.capacity() * size_of::<OperatorId>()
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

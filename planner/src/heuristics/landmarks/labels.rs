//! All fact landmarks of the delete relaxation, by label propagation.
//!
//! Idea: the label of a proposition holds the facts that every path to it makes true: the
//! proposition itself, and the intersection of the labels of all nodes that achieve it. The label
//! of a node is the union over its preconditions. Labels start as "everything" and shrink to the
//! greatest fixpoint. Facts of the initial state are omitted. Cost: nodes times the size of labels
//! times the few times that a label shrinks. A work limit makes the propagation give up on huge
//! tasks; that costs guidance, not correctness.
//!
//! Source: Zhu & Givan, "Landmark extraction via planning graph propagation", ICAPS 2003 doctoral
//! consortium; Keyder, Richter & Helmert, "Sound and complete landmarks for and/or graphs", ECAI 2010.

use crate::query::{Barred, SearchMeter};
use crate::task::{AXIOM, Relaxation};
use std::collections::VecDeque;

/// The most label elements that are merged.
const WORK: usize = 300_000_000;

/// The labels, by proposition; `None` if unreached.
pub(crate) struct Labels {
    of: Vec<Option<Box<[u32]>>>,
    initial: Vec<bool>,
}

impl Labels {
    /// Propagates labels from the propositions in `initial`; `None` if that takes too much work or
    /// is interrupted.
    pub(crate) fn new(
        graph: &Relaxation,
        initial: Vec<bool>,
        barred: &Barred,
        meter: &SearchMeter<'_>,
    ) -> Option<Self> {
        let mut labels = Self { of: vec![None; graph.propositions()], initial };
        let usable = |node: u32| {
            let operator = graph.operator[node as usize];
            operator == AXIOM || !barred.contains_number(operator)
        };
        let mut missing: Vec<u32> = (0..graph.nodes())
            .map(|n| crate::ids::id32(graph.preconditions.row(crate::ids::id32(n)).len()))
            .collect();
        let mut queue: VecDeque<u32> = graph.free.iter().copied().collect();
        let mut queued = vec![false; graph.nodes()];
        queue.iter().for_each(|&n| queued[n as usize] = true);
        for p in 0..graph.propositions() {
            if labels.initial[p] {
                labels.of[p] = Some(Box::new([]));
                let waiting = graph.needed_by.row(crate::ids::id32(p));
                if meter.spend(8 * waiting.len()) {
                    return None;
                }
                for &node in waiting {
                    missing[node as usize] -= 1;
                    if missing[node as usize] == 0 && !std::mem::replace(&mut queued[node as usize], true) {
                        queue.push_back(node);
                    }
                }
            }
        }
        let mut work = 0;
        let mut union = Vec::new();
        while let Some(node) = queue.pop_front() {
            queued[node as usize] = false;
            if !usable(node) {
                continue;
            }
            labels.union(graph, node, &mut union);
            for &p in graph.effects.row(node) {
                if labels.initial[p as usize] {
                    continue;
                }
                work += union.len() + 1;
                let first = labels.of[p as usize].is_none();
                if !labels.shrink(p, &union) {
                    continue;
                }
                let waiting = graph.needed_by.row(p);
                meter.spend(8 * waiting.len());
                for &next in waiting {
                    if first {
                        missing[next as usize] -= 1;
                    }
                    if missing[next as usize] == 0 && !std::mem::replace(&mut queued[next as usize], true) {
                        queue.push_back(next);
                    }
                }
            }
            if meter.spend(64 + (8 + graph.effects.row(node).len()) * (union.len() + 1)) || work > WORK {
                return None;
            }
        }
        Some(labels)
    }

    /// Whether the proposition holds in the initial state.
    pub(crate) fn is_initial(&self, proposition: u32) -> bool {
        self.initial[proposition as usize]
    }

    /// The landmarks of a proposition, itself included, sorted.
    pub(crate) fn of(&self, proposition: u32) -> &[u32] {
        self.of[proposition as usize].as_deref().unwrap_or(&[])
    }

    /// Whether all preconditions of the node are reached.
    pub(crate) fn reaches(&self, graph: &Relaxation, node: u32) -> bool {
        graph.preconditions.row(node).iter().all(|&p| self.of[p as usize].is_some())
    }

    /// Writes the landmarks of a node to `union`, sorted.
    pub(crate) fn union(&self, graph: &Relaxation, node: u32, union: &mut Vec<u32>) {
        union.clear();
        for &p in graph.preconditions.row(node) {
            union.extend_from_slice(self.of(p));
        }
        union.sort_unstable();
        union.dedup();
    }

    /// Intersects the label of `p` with `union` and `p` itself. Returns whether it changed.
    fn shrink(&mut self, p: u32, union: &[u32]) -> bool {
        let label = &mut self.of[p as usize];
        match label {
            None => {
                let mut first = union.to_vec();
                if let Err(at) = first.binary_search(&p) {
                    first.insert(at, p);
                }
                *label = Some(first.into());
                true
            }
            Some(old) => {
                let mut other = union.iter().copied().peekable();
                let kept: Vec<u32> = old
                    .iter()
                    .copied()
                    .filter(|&l| {
                        while other.peek().is_some_and(|&o| o < l) {
                            other.next();
                        }
                        l == p || other.peek() == Some(&l)
                    })
                    .collect();
                let changed = kept.len() < old.len();
                if changed {
                    *label = Some(kept.into());
                }
                changed
            }
        }
    }
}

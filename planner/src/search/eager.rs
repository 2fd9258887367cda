//! Best-first search that estimates states when they are generated: A*, weighted A*, greedy.
//!
//! With weight 1 and an admissible heuristic on real costs, the first plan is optimal. A state is
//! reopened when a cheaper path to it is found, so the heuristic need not be consistent. With
//! weight `w` the plan costs at most `w` times the optimum. Ties on `f` are broken by the smaller
//! estimate. The search is complete.
//!
//! Source: Hart, Nilsson & Raphael, "A formal basis for the heuristic determination of minimum cost
//! paths", 1968; Pohl, "Heuristic search viewed as path finding in a graph", AIJ 1970.

use super::order::Order;
use super::searcher::Stepwise;
use super::space::{Child, Space};
use super::{Job, Outcome, Statistics};
use crate::heuristics::{Costs, Estimate, Heuristic, HeuristicKind, View};
use crate::ids::StateId;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EagerSettings {
    /// The heuristic.
    pub(crate) heuristic: HeuristicKind,
    /// Which operator costs the heuristic counts.
    pub(crate) costs: Costs,
    /// The key by which the queue is sorted.
    pub(crate) order: Order,
}

/// The cost of the cheapest known path, and the estimate.
struct Node {
    g: u64,
    h: Estimate,
}

/// Sorted in the order of expansion: f, h, order of insertion, g, state.
type Entry = (u64, u32, u64, u64, u32);

/// The search state.
pub(crate) struct Eager<'a> {
    space: Space<'a>,
    order: Order,
    heuristic: Box<dyn Heuristic + Send + 'a>,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<Entry>>,
    inserted: u64,
    begun: bool,
}

impl<'a> Eager<'a> {
    pub(crate) fn new(job: Job<'a>, settings: &EagerSettings) -> Self {
        Self {
            heuristic: settings.heuristic.build(&job, settings.costs),
            order: settings.order,
            nodes: Vec::new(),
            open: BinaryHeap::new(),
            inserted: 0,
            begun: false,
            space: Space::new(job),
        }
    }

    fn begin(&mut self) {
        let start = self.space.root();
        self.heuristic.start(start, &self.space.next);
        let h = self.estimate(start);
        self.nodes.push(Node { g: 0, h });
        self.queue(start, 0, h);
    }

    fn estimate(&mut self, id: StateId) -> Estimate {
        self.space.statistics.evaluated += 1;
        self.heuristic.estimate(&View { id, words: &self.space.next, applicable: &[] }, None)
    }

    fn queue(&mut self, id: StateId, g: u64, h: Estimate) {
        if h != Estimate::DEAD_END {
            self.inserted += 1;
            self.open.push(Reverse((self.order.key(g, h), h.0, self.inserted, g, id.0)));
        }
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some(Reverse((_, _, _, g, id))) = self.open.pop() else {
            // A search that keeps the cheapest paths has lost no plan below the bound.
            return Some(self.space.exhausted(self.space.is_bounded && self.order == Order::Greedy));
        };
        let id = StateId(id);
        if self.nodes[id.0 as usize].g < g {
            return None;
        }
        self.space.read(id);
        if self.space.job.goal.holds_in(&self.space.here) {
            return Some(Outcome::Solved(self.space.plan(id)));
        }
        self.space.expand(id, g);
        while let Some(Child { id: child, is_new, operator, cost }) = self.space.child() {
            self.heuristic.step(id, operator, child, &self.space.next);
            let h = if is_new {
                let h = self.estimate(child);
                self.nodes.push(Node { g: cost, h });
                h
            } else {
                let node = &mut self.nodes[child.0 as usize];
                if self.order == Order::Greedy || node.g <= cost {
                    continue;
                }
                node.g = cost;
                self.space.registry.reparent(child, id, operator);
                node.h
            };
            self.queue(child, cost, h);
        }
        None
    }
}

impl Stepwise for Eager<'_> {
    fn job(&self) -> &Job<'_> {
        &self.space.job
    }

    fn memory(&self) -> usize {
        self.space.registry.memory()
            + self.nodes.capacity() * size_of::<Node>()
            + self.open.capacity() * size_of::<Entry>()
            + self.heuristic.memory()
    }

    fn statistics(&self) -> Statistics {
        self.space.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if !std::mem::replace(&mut self.begun, true) {
            self.begin();
            return None;
        }
        self.step()
    }
}

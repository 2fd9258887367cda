//! Best-first search that estimates states when they are generated: A*, weighted A*, greedy.
//!
//! With weight 1 and an admissible heuristic on real costs the first plan is optimal; states are
//! reopened when a cheaper way is found, so consistency is not required. With weight `w` the plan costs
//! at most `w` times the optimum. Ties on `f` go to the smaller estimate. Complete.
//!
//! Source: Hart, Nilsson & Raphael, "A formal basis for the heuristic determination of minimum cost
//! paths", 1968; Pohl, "Heuristic search viewed as path finding in a graph", AIJ 1970.

use super::meter::price_of_state;
use super::registry::StateRegistry;
use super::searcher::Stepwise;
use super::{Job, Limit, Order, Outcome, Plan, Statistics, UnsolvableReason};
use crate::heuristics::{Costs, Estimate, Heuristic, HeuristicKind, View};
use crate::ids::{OperatorId, StateId};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The parameters.
#[derive(Clone, Copy, Debug)]
pub struct EagerSettings {
    /// The estimator.
    pub heuristic: HeuristicKind,
    /// What it counts.
    pub costs: Costs,
    /// What the queue is sorted by.
    pub order: Order,
}

/// Cost of the best known way, and the estimate.
struct Node {
    g: u64,
    h: Estimate,
}

/// In the order of expansion: f, h, order of insertion, g, state.
type Entry = (u64, u32, u64, u64, u32);

/// The search.
pub(crate) struct Eager<'a> {
    job: Job<'a>,
    order: Order,
    heuristic: Box<dyn Heuristic + Send + 'a>,
    registry: StateRegistry<'a>,
    nodes: Vec<Node>,
    open: BinaryHeap<Reverse<Entry>>,
    inserted: u64,
    begun: bool,
    pruned: bool,
    statistics: Statistics,
    successors: Vec<OperatorId>,
    here: Vec<u64>,
    next: Vec<u64>,
}

impl<'a> Eager<'a> {
    pub(crate) fn new(job: Job<'a>, settings: &EagerSettings) -> Self {
        Self {
            heuristic: settings.heuristic.build(&job, settings.costs),
            order: settings.order,
            registry: StateRegistry::new(job.task, job.state.words()),
            nodes: Vec::new(),
            open: BinaryHeap::new(),
            inserted: 0,
            begun: false,
            pruned: false,
            statistics: Statistics::default(),
            successors: Vec::new(),
            here: job.state.words().to_vec(),
            next: job.state.words().to_vec(),
            job,
        }
    }

    fn begin(&mut self) {
        let (start, _) = self.registry.insert(&self.next, None);
        self.heuristic.start(start, &self.next);
        let h = self.estimate(start);
        self.nodes.push(Node { g: 0, h });
        self.queue(start, 0, h);
    }

    fn estimate(&mut self, id: StateId) -> Estimate {
        self.statistics.evaluated += 1;
        self.heuristic.estimate(&View { id, words: &self.next, applicable: &[] }, None)
    }

    fn queue(&mut self, id: StateId, g: u64, h: Estimate) {
        if h != Estimate::DEAD_END {
            self.inserted += 1;
            self.open.push(Reverse((self.order.key(g, h), h.0, self.inserted, g, id.0)));
        }
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some(Reverse((_, _, _, g, id))) = self.open.pop() else {
            return Some(match self.pruned {
                true => Outcome::LimitReached(Limit::Incomplete),
                false => Outcome::Unsolvable(UnsolvableReason::SpaceExhausted),
            });
        };
        let id = StateId(id);
        if self.nodes[id.0 as usize].g < g {
            return None;
        }
        let (task, meter) = (self.job.task, self.job.meter);
        self.registry.read(id, &mut self.here);
        if self.job.goal.holds_in(&self.here) {
            return Some(Outcome::Solved(Plan::of(task, self.registry.path(id))));
        }
        self.statistics.expanded += 1;
        self.successors.clear();
        task.successors.applicable(&self.here, &mut self.successors);
        self.job.barred.filter(&mut self.successors);
        for i in 0..self.successors.len() {
            if meter.spend(price_of_state(self.next.len())) {
                return None;
            }
            let operator = self.successors[i];
            let cost = g + u64::from(task.operators[operator].cost);
            if cost >= self.job.bound.get() {
                self.pruned |= self.order == Order::Greedy;
                continue;
            }
            self.statistics.generated += 1;
            self.next.copy_from_slice(&self.here);
            if !task.apply(operator, &self.here, &mut self.next) {
                self.pruned = true;
                continue;
            }
            let (child, new) = self.registry.insert(&self.next, Some((id, operator)));
            self.heuristic.step(id, operator, child, &self.next);
            let h = if new {
                let h = self.estimate(child);
                self.nodes.push(Node { g: cost, h });
                h
            } else {
                let node = &mut self.nodes[child.0 as usize];
                if self.order == Order::Greedy || node.g <= cost {
                    continue;
                }
                node.g = cost;
                self.registry.reparent(child, id, operator);
                node.h
            };
            self.queue(child, cost, h);
        }
        None
    }
}

impl Stepwise for Eager<'_> {
    fn job(&self) -> &Job<'_> {
        &self.job
    }

    fn memory(&self) -> usize {
        self.registry.memory()
            + self.nodes.capacity() * size_of::<Node>()
            + self.open.capacity() * size_of::<Entry>()
            + self.heuristic.memory()
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if !std::mem::replace(&mut self.begun, true) {
            self.begin();
            return None;
        }
        self.step()
    }
}

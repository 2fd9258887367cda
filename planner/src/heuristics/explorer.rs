//! Cheapest achievement in the delete relaxation: a generalised Dijkstra.
//!
//! Problem: hmax, hadd and hFF all need, per state, the cost of every proposition. Idea: settle
//! propositions in order of cost; a node whose last precondition is settled offers its effects at the
//! sum (or maximum) of its preconditions' costs plus its own. Invariant: when a proposition is
//! popped at its cost, that cost is final. Cost: linear in the relaxation, plus the queue; arrays are
//! reset by copying templates, nothing is allocated.
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001; Liu, Koenig & Furcy, "Speeding
//! up the calculation of heuristics for heuristic search-based planning", AAAI 2002.

use crate::heuristics::Costs;
use crate::ids::id32;
use crate::search::{Job, Meter};
use crate::task::{AXIOM, Relaxation};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Not reached.
pub(crate) const UNREACHED: u32 = u32::MAX;
/// Costs above this saturate.
const HIGHEST: u32 = u32::MAX / 4;
/// Queue entries cheaper than this have a bucket of their own.
const BUCKETS: usize = 1 << 14;

/// How the costs of a conjunction combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combine {
    Sum,
    Max,
}

#[derive(Clone, Copy)]
struct Node {
    cost: u32,
    missing: u32,
}

/// Scratch for explorations of one task under one set of costs.
pub(crate) struct Explorer<'a> {
    graph: &'a Relaxation,
    meter: &'a Meter<'a>,
    combine: Combine,
    template: Vec<Node>,
    nodes: Vec<Node>,
    cost: Vec<u32>,
    supporter: Vec<u32>,
    buckets: Vec<Vec<u32>>,
    lowest: usize,
    queued: usize,
    overflow: BinaryHeap<Reverse<(u32, u32)>>,
    goal: Vec<u32>,
    is_goal: Vec<bool>,
}

impl<'a> Explorer<'a> {
    /// On the undominated relaxation.
    pub(crate) fn new(job: &Job<'a>, goal: Vec<u32>, costs: Costs, combine: Combine) -> Self {
        Self::on(job.relaxation(), job, goal, costs, combine)
    }

    /// On a graph of the caller's choice.
    pub(crate) fn on(
        graph: &'a Relaxation,
        job: &Job<'a>,
        goal: Vec<u32>,
        costs: Costs,
        combine: Combine,
    ) -> Self {
        let barred = job.barred;
        let template: Vec<Node> = (0..graph.nodes())
            .map(|n| {
                let operator = graph.operator[n];
                let cost = if operator == AXIOM { 0 } else { costs.of(graph.cost[n]) };
                let missing = id32(graph.preconditions.row(id32(n)).len());
                // A barred node waits for a precondition that never comes.
                let extra = u32::from(operator != AXIOM && barred.contains_number(operator));
                Node { cost, missing: missing + extra }
            })
            .collect();
        let mut is_goal = vec![false; graph.propositions()];
        goal.iter().for_each(|&p| is_goal[p as usize] = true);
        Self {
            graph,
            meter: job.meter,
            combine,
            nodes: template.clone(),
            template,
            cost: vec![UNREACHED; graph.propositions()],
            supporter: vec![UNREACHED; graph.propositions()],
            buckets: Vec::new(),
            lowest: 0,
            queued: 0,
            overflow: BinaryHeap::new(),
            goal,
            is_goal,
        }
    }

    pub(crate) fn graph(&self) -> &'a Relaxation {
        self.graph
    }

    pub(crate) fn goal(&self) -> &[u32] {
        &self.goal
    }

    /// The cost of a proposition after the last exploration.
    pub(crate) fn cost(&self, proposition: u32) -> u32 {
        self.cost[proposition as usize]
    }

    /// The node that achieves it most cheaply; [`UNREACHED`] for what holds already.
    pub(crate) fn supporter(&self, proposition: u32) -> u32 {
        self.supporter[proposition as usize]
    }

    /// Whether everything that the node needs costs nothing.
    pub(crate) fn is_ready(&self, node: u32) -> bool {
        self.nodes[node as usize].cost == self.template[node as usize].cost
    }

    /// Whether everything that the node needs was reached.
    pub(crate) fn is_fired(&self, node: u32) -> bool {
        self.nodes[node as usize].missing == 0
    }

    /// Changes the cost of a node for the explorations to come.
    pub(crate) fn set_cost(&mut self, node: u32, cost: u32) {
        self.template[node as usize].cost = cost;
    }

    /// Settles propositions from the state until the whole goal is settled (or all, without goals).
    /// Answers whether the goal was reached; where the meter is stopped, that is not to be believed.
    pub(crate) fn explore(&mut self, words: &[u64]) -> bool {
        self.reset();
        self.meter.spend((self.nodes.len() + self.cost.len()) / 8);
        let graph = self.graph;
        graph.for_each_true(words, |p| self.offer(p, 0, UNREACHED));
        for &node in &graph.free {
            if self.nodes[node as usize].missing == 0 {
                self.fire(node);
            }
        }
        let mut open = self.goal.len();
        let everything = open == 0;
        while let Some((cost, proposition)) = self.pop() {
            if self.cost[proposition as usize] != cost {
                continue;
            }
            if self.is_goal[proposition as usize] {
                open -= 1;
                if open == 0 {
                    return true;
                }
            }
            let waiting = graph.needed_by.row(proposition);
            if self.meter.spend(waiting.len() + 1) {
                return false;
            }
            for &n in waiting {
                let node = &mut self.nodes[n as usize];
                match self.combine {
                    Combine::Sum => node.cost = (node.cost + cost).min(HIGHEST),
                    Combine::Max => {
                        let base = self.template[n as usize].cost;
                        node.cost = node.cost.max((base + cost).min(HIGHEST));
                    }
                }
                node.missing -= 1;
                if node.missing == 0 {
                    self.fire(n);
                }
            }
        }
        everything
    }

    fn reset(&mut self) {
        self.nodes.copy_from_slice(&self.template);
        self.cost.fill(UNREACHED);
        if self.queued > 0 {
            self.buckets.iter_mut().for_each(Vec::clear);
            self.queued = 0;
        }
        self.overflow.clear();
        self.lowest = 0;
    }

    fn fire(&mut self, node: u32) {
        let cost = self.nodes[node as usize].cost;
        for &p in self.graph.effects.row(node) {
            self.offer(p, cost, node);
        }
    }

    fn offer(&mut self, proposition: u32, cost: u32, by: u32) {
        let known = &mut self.cost[proposition as usize];
        if cost < *known {
            *known = cost;
            self.supporter[proposition as usize] = by;
            self.push(cost, proposition);
        }
    }

    fn push(&mut self, cost: u32, proposition: u32) {
        let bucket = cost as usize;
        if bucket >= BUCKETS {
            self.overflow.push(Reverse((cost, proposition)));
            return;
        }
        if bucket >= self.buckets.len() {
            self.buckets.resize_with(bucket + 1, Vec::new);
        }
        self.buckets[bucket].push(proposition);
        self.queued += 1;
        self.lowest = self.lowest.min(bucket);
    }

    fn pop(&mut self) -> Option<(u32, u32)> {
        if self.queued > 0 {
            loop {
                if let Some(p) = self.buckets[self.lowest].pop() {
                    self.queued -= 1;
                    return Some((id32(self.lowest), p));
                }
                self.lowest += 1;
            }
        }
        self.overflow.pop().map(|Reverse(entry)| entry)
    }
}

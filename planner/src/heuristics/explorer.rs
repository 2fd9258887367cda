//! Costs of propositions in the delete relaxation, by a generalised Dijkstra search.
//!
//! Problem: hmax, hadd and hFF all need the cost of every proposition, in each state. Idea: settle
//! propositions in order of cost. When the last precondition of a node is settled, the node offers
//! its effects at its own cost plus the sum (or maximum) of its preconditions' costs. Invariant:
//! when a proposition is popped at its cost, that cost is final. On request, comparisons of numbers
//! count repetitions (`repetitions`). A move needs no counter: it fires when its only precondition
//! is settled, and only the first settled member of a clique fires. Cost: linear in the relaxation,
//! plus the queue. Arrays are reset by copying templates; nothing is allocated.
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001; Liu, Koenig & Furcy, "Speeding
//! up the calculation of heuristics for heuristic search-based planning", AAAI 2002.

use crate::heuristics::Costs;
use crate::heuristics::Job;
use crate::heuristics::repetitions::Repetitions;
use crate::ids::id32;
use crate::query::SearchMeter;
use crate::task::{ALONE, AXIOM, Relaxation, Way};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Nodes between two checks of the meter.
const STRIDE: usize = 1 << 12;

/// The cost of an unreached proposition.
pub(crate) const UNREACHED: u32 = u32::MAX;
/// Higher costs saturate at this.
const HIGHEST: u32 = u32::MAX / 4;
/// Queue entries with a lower cost have their own bucket.
const BUCKETS: usize = 1 << 14;

/// How the costs of the preconditions combine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Combine {
    Sum,
    Max,
}

/// How often an operator is counted to achieve a comparison of numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Counting {
    /// The operator counts once.
    Once,
    /// The operator counts as often as the state's numbers require.
    Repetitions,
}

#[derive(Clone, Copy)]
struct Node {
    cost: u32,
    missing: u32,
}

/// Buffers for explorations of one task with one set of costs.
pub(crate) struct Explorer<'a> {
    graph: &'a Relaxation,
    meter: &'a SearchMeter<'a>,
    combine: Combine,
    repetitions: Option<Repetitions<'a>>,
    /// The first node that raises a comparison that holds already; empty if repetitions are not
    /// counted.
    supplier: Vec<u32>,
    template: Vec<Node>,
    /// The state of every node but the moves.
    nodes: Vec<Node>,
    /// By clique: the exploration in which its moves fired.
    moved: Vec<u32>,
    exploration: u32,
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
    /// Explores the undominated relaxation.
    pub(crate) fn new(job: &Job<'a>, goal: Vec<u32>, costs: Costs, combine: Combine) -> Self {
        Self::on(job.relaxation(), job, goal, costs, combine, Counting::Repetitions)
    }

    /// Explores the relaxation `graph`.
    pub(crate) fn on(
        graph: &'a Relaxation,
        job: &Job<'a>,
        goal: Vec<u32>,
        costs: Costs,
        combine: Combine,
        counting: Counting,
    ) -> Self {
        let barred = job.barred;
        let mut template = vec![Node { cost: 0, missing: 0 }; graph.nodes()];
        for (n, node) in template.iter_mut().enumerate() {
            // If the meter is stopped, the remaining nodes stay unexplored.
            if n.is_multiple_of(STRIDE) && job.meter.spend(8 * STRIDE) {
                break;
            }
            let operator = graph.operator[n];
            node.cost = if operator == AXIOM { 0 } else { costs.of(graph.cost[n]) };
            let missing = id32(graph.preconditions.row(id32(n)).len());
            // A barred node waits for one more precondition, which is never reached.
            node.missing = missing + u32::from(operator != AXIOM && barred.contains_number(operator));
        }
        let repetitions = match counting {
            Counting::Once => None,
            Counting::Repetitions => Repetitions::new(graph, &job.task.numeric),
        };
        let repetitions = match combine {
            Combine::Sum => repetitions,
            Combine::Max => repetitions.map(|r| r.with_prices(|node| template[node as usize].cost)),
        };
        let mut is_goal = vec![false; graph.propositions()];
        goal.iter().for_each(|&p| is_goal[p as usize] = true);
        Self {
            graph,
            meter: job.meter,
            combine,
            supplier: match (&repetitions, combine) {
                (Some(_), Combine::Sum) => vec![UNREACHED; graph.propositions()],
                _ => Vec::new(),
            },
            repetitions,
            nodes: template[..graph.first_move as usize].to_vec(),
            template,
            moved: vec![0; graph.cliques],
            exploration: 0,
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

    pub(crate) fn is_goal(&self, proposition: u32) -> bool {
        self.is_goal[proposition as usize]
    }

    pub(crate) fn goal(&self) -> &[u32] {
        &self.goal
    }

    /// The cost of a proposition after the last exploration.
    pub(crate) fn cost(&self, proposition: u32) -> u32 {
        self.cost[proposition as usize]
    }

    /// The node that achieves a proposition most cheaply; [`UNREACHED`] if the proposition holds
    /// already.
    pub(crate) fn supporter(&self, proposition: u32) -> u32 {
        self.supporter[proposition as usize]
    }

    /// The first node that raises a comparison that holds already; [`UNREACHED`] if there is none.
    pub(crate) fn supplier(&self, proposition: u32) -> u32 {
        self.supplier.get(proposition as usize).copied().unwrap_or(UNREACHED)
    }

    /// How often a node must be applied in this state to achieve a proposition, if its comparison
    /// needs `more` units than its bound.
    pub(crate) fn times(&self, node: u32, proposition: u32, more: f64, words: &[u64]) -> u32 {
        let Some(repetitions) = &self.repetitions else { return 1 };
        let effects = &self.graph.effects;
        let effect = effects.range(node).find(|&effect| effects.item(effect) == proposition);
        effect.and_then(|effect| repetitions.count(effect, more, words)).unwrap_or(1)
    }

    /// Whether all preconditions of the node cost nothing.
    pub(crate) fn is_ready(&self, node: u32) -> bool {
        match self.nodes.get(node as usize) {
            Some(state) => state.cost == self.template[node as usize].cost,
            None => self.cost[self.graph.preconditions.row(node)[0] as usize] == 0,
        }
    }

    /// Whether all preconditions of the node were reached.
    pub(crate) fn is_fired(&self, node: u32) -> bool {
        match self.nodes.get(node as usize) {
            Some(state) => state.missing == 0,
            None => self.cost[self.graph.preconditions.row(node)[0] as usize] != UNREACHED,
        }
    }

    /// Changes the cost of a node for later explorations.
    pub(crate) fn set_cost(&mut self, node: u32, cost: u32) {
        self.template[node as usize].cost = cost;
    }

    /// Settles propositions from the state until the whole goal is settled (or all propositions,
    /// without a goal). Returns whether the goal was reached; if the meter is stopped, the result
    /// is unreliable.
    pub(crate) fn explore(&mut self, words: &[u64]) -> bool {
        if self.meter.spend((self.nodes.len() + self.cost.len()) / 8) {
            return false;
        }
        self.reset();
        let graph = self.graph;
        graph.for_each_true(words, |p| self.offer(p, 0, UNREACHED));
        for &node in &graph.free {
            if self.nodes[node as usize].missing == 0 {
                self.fire(node, self.nodes[node as usize].cost, words);
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
            let (waiting, moves) = graph.waiting_and_moves(proposition);
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
                    let cost = node.cost;
                    self.fire(n, cost, words);
                }
            }
            if moves.is_empty() || !self.is_first(graph.clique[proposition as usize]) {
                continue;
            }
            if self.meter.spend(moves.len()) {
                return false;
            }
            for &n in moves {
                let base = self.template[n as usize].cost;
                self.fire(n, (base + cost).min(HIGHEST), words);
            }
        }
        everything
    }

    /// Whether no member of the clique was settled before.
    fn is_first(&mut self, clique: u32) -> bool {
        clique == ALONE
            || std::mem::replace(&mut self.moved[clique as usize], self.exploration) != self.exploration
    }

    fn reset(&mut self) {
        let waiting = self.nodes.len();
        self.nodes.copy_from_slice(&self.template[..waiting]);
        self.exploration = self.exploration.checked_add(1).unwrap_or_else(|| {
            self.moved.fill(0);
            1
        });
        self.cost.fill(UNREACHED);
        self.supplier.fill(UNREACHED);
        if self.queued > 0 {
            self.buckets.iter_mut().for_each(Vec::clear);
            self.queued = 0;
        }
        self.overflow.clear();
        self.lowest = 0;
    }

    /// Offers the effects of a node at this cost, which includes its preconditions.
    #[inline]
    fn fire(&mut self, node: u32, cost: u32, words: &[u64]) {
        if self.repetitions.is_some() {
            return self.fire_repeatedly(node, cost, words);
        }
        for &p in self.graph.effects.row(node) {
            self.offer(p, cost, node);
        }
    }

    /// The same, if comparisons of numbers count repetitions.
    fn fire_repeatedly(&mut self, node: u32, cost: u32, words: &[u64]) {
        let effects = &self.graph.effects;
        for effect in effects.range(node) {
            let p = effects.item(effect);
            if self.cost[p as usize] == 0
                && let Some(supplier @ &mut UNREACHED) = self.supplier.get_mut(p as usize)
                && *self.graph.ways.get(effect) != Way::Once
            {
                *supplier = node;
            }
            if cost < self.cost[p as usize]
                && let Some(cost) = self.repeated(node, cost, effect, words)
            {
                self.offer(p, cost, node);
            }
        }
    }

    /// The cost of a node's effect with its repetitions; `None` if it can never be achieved.
    fn repeated(&self, node: u32, cost: u32, effect: usize, words: &[u64]) -> Option<u32> {
        let Some(repetitions) = &self.repetitions else { return Some(cost) };
        let times = repetitions.count(effect, 0.0, words)?;
        Some(match self.combine {
            Combine::Sum => {
                let more = times.saturating_sub(1).saturating_mul(self.template[node as usize].cost);
                cost.saturating_add(more).min(HIGHEST)
            }
            Combine::Max => cost.max(repetitions.bound(effect, words)).min(HIGHEST),
        })
    }

    #[inline]
    fn offer(&mut self, proposition: u32, cost: u32, by: u32) {
        let known = &mut self.cost[proposition as usize];
        if cost < *known {
            *known = cost;
            self.supporter[proposition as usize] = by;
            self.push(cost, proposition);
        }
    }

    #[inline]
    fn push(&mut self, cost: u32, proposition: u32) {
        let bucket = cost as usize;
        if bucket >= self.buckets.len() {
            return self.push_far(cost, proposition);
        }
        self.buckets[bucket].push(proposition);
        self.queued += 1;
        self.lowest = self.lowest.min(bucket);
    }

    /// Handles costs without a bucket.
    #[cold]
    fn push_far(&mut self, cost: u32, proposition: u32) {
        let bucket = cost as usize;
        if bucket >= BUCKETS {
            self.overflow.push(Reverse((cost, proposition)));
            return;
        }
        self.buckets.resize_with(bucket + 1, Vec::new);
        self.push(cost, proposition);
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

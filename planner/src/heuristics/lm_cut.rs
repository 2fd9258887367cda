//! LM-cut: a sum of disjunctive landmarks of the delete relaxation.
//!
//! Idea: compute hmax. The goal zone is the set of propositions from which the goal costs nothing.
//! While hmax of the goal is positive, the operators that cross into the goal zone form a landmark.
//! Add the cost of its cheapest operator to the estimate, subtract it from all operators of the
//! landmark, and repeat. Costs are per operator: the nodes of conditional effects share the cost of
//! their operator, so the sum stays admissible. Axioms cost nothing. Admissible, not consistent,
//! safe. Cost: one exploration per cut.
//!
//! Source: Helmert & Domshlak, "Landmarks, critical paths and abstractions: what's the difference
//! anyway?", ICAPS 2009.

use super::explorer::UNREACHED;
use super::{Combine, Costs, Counting, Estimate, Explorer, Heuristic, View};
use crate::heuristics::Job;
use crate::ids::{OperatorId, id32};
use crate::query::SearchMeter;
use crate::task::{AXIOM, Relaxation, Rows};

pub(crate) struct LmCut<'a> {
    graph: &'a Relaxation,
    meter: &'a SearchMeter<'a>,
    explorer: Explorer<'a>,
    goal: Vec<u32>,
    achieved_by: Rows,
    costs: Vec<u32>,
    remaining: Vec<u32>,
    /// The most expensive precondition of each node.
    dearest: Vec<u32>,
    /// Nodes by their most expensive precondition, rebuilt for each cut.
    waiting: Vec<Vec<u32>>,
}

impl<'a> LmCut<'a> {
    pub(crate) fn new(job: &Job<'a>, costs: Costs) -> Self {
        let graph = &job.task.relaxation;
        Self {
            meter: job.meter,
            explorer: Explorer::on(graph, job, Vec::new(), costs, Combine::Max, Counting::Once),
            goal: graph.literals(&job.goal.literals),
            // Once the meter is stopped, the estimate is not used.
            achieved_by: graph
                .effects
                .transposed(graph.propositions(), job.meter.meter())
                .unwrap_or_else(|_| Rows::empty(graph.propositions())),
            costs: job.task.operators.iter().map(|o| costs.of(o.cost)).collect(),
            remaining: Vec::new(),
            dearest: vec![UNREACHED; graph.nodes()],
            waiting: vec![Vec::new(); graph.propositions()],
            graph,
        }
    }

    fn price(&self, node: u32) -> u32 {
        match self.graph.operator[node as usize] {
            AXIOM => 0,
            operator => self.remaining[operator as usize],
        }
    }

    /// Marks the propositions from which the goal costs nothing.
    fn zone(&self, goal: u32) -> Vec<bool> {
        let mut zone = vec![false; self.graph.propositions()];
        let mut stack = vec![goal];
        zone[goal as usize] = true;
        while let Some(p) = stack.pop() {
            for &node in self.achieved_by.row(p) {
                let before = self.dearest[node as usize];
                if before != UNREACHED && self.price(node) == 0 && !zone[before as usize] {
                    zone[before as usize] = true;
                    stack.push(before);
                }
            }
        }
        zone
    }

    /// The nodes that cross into the zone from outside.
    fn cut(&mut self, words: &[u64], zone: &[bool]) -> Vec<u32> {
        let mut seen = vec![false; self.graph.propositions()];
        let mut stack = Vec::new();
        let reach = |p: u32, seen: &mut [bool], stack: &mut Vec<u32>| {
            if !zone[p as usize] && !std::mem::replace(&mut seen[p as usize], true) {
                stack.push(p);
            }
        };
        self.graph.for_each_true(words, |p| reach(p, &mut seen, &mut stack));
        let mut crossing = Vec::new();
        let mut pass = |node: u32, seen: &mut [bool], stack: &mut Vec<u32>| {
            let effects = self.graph.effects.row(node);
            if effects.iter().any(|&p| zone[p as usize]) {
                crossing.push(node);
            }
            effects.iter().for_each(|&p| reach(p, seen, stack));
        };
        for &node in &self.graph.free {
            if self.explorer.is_fired(node) {
                pass(node, &mut seen, &mut stack);
            }
        }
        while let Some(p) = stack.pop() {
            for &node in &self.waiting[p as usize] {
                pass(node, &mut seen, &mut stack);
            }
        }
        crossing
    }

    fn find_dearest(&mut self) {
        self.waiting.iter_mut().for_each(Vec::clear);
        for node in 0..id32(self.graph.nodes()) {
            let row = self.graph.preconditions.row(node);
            let fired = self.explorer.is_fired(node);
            let dearest = row.iter().copied().max_by_key(|&p| self.explorer.cost(p)).filter(|_| fired);
            self.dearest[node as usize] = dearest.unwrap_or(UNREACHED);
            if let Some(p) = dearest {
                self.waiting[p as usize].push(node);
            }
        }
    }
}

impl Heuristic for LmCut<'_> {
    fn estimate(&mut self, view: &View<'_>, _: Option<&mut Vec<OperatorId>>) -> Estimate {
        let words = view.words;
        self.remaining.clone_from(&self.costs);
        let mut total = 0_u32;
        loop {
            for node in 0..id32(self.graph.nodes()) {
                self.explorer.set_cost(node, self.price(node));
            }
            self.explorer.explore(words);
            if self.meter.is_stopped() {
                return Estimate(total);
            }
            let Some(&goal) = self.goal.iter().max_by_key(|&&p| self.explorer.cost(p)) else {
                return Estimate(0);
            };
            match self.explorer.cost(goal) {
                UNREACHED => return Estimate::DEAD_END,
                0 => return Estimate(total),
                _ => {}
            }
            self.find_dearest();
            let zone = self.zone(goal);
            let crossing = self.cut(words, &zone);
            let Some(least) = crossing.iter().map(|&n| self.price(n)).min().filter(|&l| l > 0) else {
                // Every path into the zone has a positive cost, so this is unreachable.
                debug_assert!(false, "a cut of positive cost exists while hmax is positive");
                return Estimate(total);
            };
            let mut operators: Vec<u32> = crossing.iter().map(|&n| self.graph.operator[n as usize]).collect();
            operators.sort_unstable();
            operators.dedup();
            for o in operators {
                self.remaining[o as usize] -= least;
            }
            total = total.saturating_add(least).min(u32::MAX - 1);
        }
    }
}

//! The landmark-count heuristic: the cost of the landmarks that are still to be achieved.
//!
//! Idea: a landmark is accepted on a path once it holds and all landmarks ordered before it were
//! accepted. An accepted landmark is needed again if it does not hold, and it is a goal or must
//! hold right before a landmark that is not accepted. Each counts the cost of its cheapest achiever
//! (1 if all operators count 1). Operators that achieve a landmark next are preferred.
//! Path-dependent: each state keeps the accepted set of the path that found it. Neither admissible
//! nor consistent; safe: infinite only if a goal was lost that no operator achieves.
//!
//! Source: Richter & Westphal, "The LAMA planner", JAIR 2010, §4.

use super::graph::LandmarkGraph;
use crate::heuristics::Job;
use crate::heuristics::{Costs, Estimate, Heuristic, View};
use crate::ids::{OperatorId, StateId, id32};
use crate::query::SearchMeter;
use crate::task::{Relaxation, Task, contains};

pub(crate) struct LandmarkCount<'a> {
    task: &'a Task,
    graph: &'a Relaxation,
    meter: &'a SearchMeter<'a>,
    landmarks: &'a LandmarkGraph,
    /// The cost that each landmark counts.
    prices: Vec<u32>,
    width: usize,
    /// Accepted landmarks, `width` words a state.
    accepted: Vec<u64>,
}

impl<'a> LandmarkCount<'a> {
    pub(crate) fn new(job: &Job<'a>, costs: Costs) -> Self {
        let (task, graph, landmarks) = (job.task, job.relaxation(), job.landmarks());
        let width = landmarks.landmarks.len().div_ceil(64);
        let prices = prices(graph, landmarks, costs);
        Self { task, graph, meter: job.meter, landmarks, prices, width, accepted: Vec::new() }
    }

    fn holds(&self, landmark: usize, words: &[u64]) -> bool {
        self.landmarks.landmarks[landmark].propositions.iter().any(|&p| {
            let (fact, positive) = self.graph.literal(p);
            contains(words, fact) == positive
        })
    }

    fn accepted(&self, id: StateId) -> &[u64] {
        &self.accepted[id.0 as usize * self.width..(id.0 as usize + 1) * self.width]
    }

    fn may_come(&self, landmark: usize, accepted: &[u64]) -> bool {
        self.landmarks.landmarks[landmark].before.iter().all(|&b| bit(accepted, b as usize))
    }

    /// The operators that achieve a landmark whose predecessors are accepted; single facts come
    /// before disjunctions.
    fn promising(&self, accepted: &[u64], applicable: &[OperatorId], preferred: &mut Vec<OperatorId>) {
        let mut disjunctive = Vec::new();
        let before = preferred.len();
        for &operator in applicable {
            let op = self.task.operator(operator);
            let adds = op.adds.iter().chain(op.conditional.iter().flat_map(|e| e.adds.iter()));
            let (mut single, mut any) = (false, false);
            for fact in adds {
                for &l in self.landmarks.of.get(&fact.0).map_or(&[][..], Vec::as_slice) {
                    let l = l as usize;
                    if !bit(accepted, l) && self.may_come(l, accepted) {
                        any = true;
                        single |= self.landmarks.landmarks[l].propositions.len() == 1;
                    }
                }
            }
            if single {
                preferred.push(operator);
            } else if any {
                disjunctive.push(operator);
            }
        }
        if preferred.len() == before {
            preferred.extend(disjunctive);
        }
    }
}

/// By landmark: the counted cost of its cheapest achiever.
fn prices(graph: &Relaxation, landmarks: &LandmarkGraph, costs: Costs) -> Vec<u32> {
    if costs == Costs::Unit {
        return vec![1; landmarks.landmarks.len()];
    }
    let mut cheapest = vec![u32::MAX; graph.propositions()];
    for node in 0..id32(graph.nodes()) {
        let (operator, cost) = graph.price(node);
        let cost = if operator { costs.of(cost) } else { 0 };
        for &p in graph.effects.row(node) {
            cheapest[p as usize] = cheapest[p as usize].min(cost);
        }
    }
    let price = |p: &u32| Some(cheapest[*p as usize]).filter(|&c| c != u32::MAX);
    // A landmark without achievers holds at the start or never; then its price has no effect.
    landmarks.landmarks.iter().map(|l| l.propositions.iter().filter_map(price).min().unwrap_or(1)).collect()
}

fn bit(words: &[u64], i: usize) -> bool {
    words[i / 64] >> (i % 64) & 1 == 1
}

impl Heuristic for LandmarkCount<'_> {
    fn start(&mut self, _: StateId, words: &[u64]) {
        let mut accepted = vec![0; self.width];
        for l in 0..self.landmarks.landmarks.len() {
            if self.holds(l, words) && self.landmarks.landmarks[l].before.is_empty() {
                accepted[l / 64] |= 1 << (l % 64);
            }
        }
        self.accepted = accepted;
    }

    fn step(&mut self, from: StateId, _: OperatorId, to: StateId, words: &[u64]) {
        if to.0 as usize * self.width < self.accepted.len() {
            return;
        }
        let mut accepted = self.accepted(from).to_vec();
        for l in 0..self.landmarks.landmarks.len() {
            if !bit(&accepted, l) && self.holds(l, words) && self.may_come(l, self.accepted(from)) {
                accepted[l / 64] |= 1 << (l % 64);
            }
        }
        self.accepted.extend(accepted);
    }

    fn estimate(&mut self, view: &View<'_>, preferred: Option<&mut Vec<OperatorId>>) -> Estimate {
        let accepted = self.accepted(view.id);
        let mut open = 0_u32;
        for (l, landmark) in self.landmarks.landmarks.iter().enumerate() {
            let needed = if bit(accepted, l) {
                (landmark.is_goal || landmark.needed_for.iter().any(|&n| !bit(accepted, n as usize)))
                    && !self.holds(l, view.words)
            } else {
                true
            };
            if needed && landmark.is_goal && landmark.is_final && !self.holds(l, view.words) {
                return Estimate::DEAD_END;
            }
            if needed {
                open = open.saturating_add(self.prices[l]);
            }
        }
        self.meter.spend(self.landmarks.landmarks.len() * 4);
        if let Some(preferred) = preferred {
            self.promising(accepted, view.applicable, preferred);
        }
        Estimate(open.min(u32::MAX - 1))
    }

    fn memory(&self) -> usize {
        self.accepted.capacity() * 8
    }
}

//! A sequence of searches for cheaper and cheaper plans.

use super::lazy::{Lazy, LazySettings, Pruning};
use super::order::Order;
use super::outcome::{Outcome, Statistics};
use super::searcher::Searcher;
use crate::heuristics::{Costs, HeuristicKind, Job};
use crate::query::{Limit, Turn};
use crate::task::Task;

/// The costs that the heuristics count if plans should get cheaper. If all operators cost the same,
/// one is not added to each, so that estimates and costs have the same scale.
pub(crate) fn counted(task: &Task) -> Costs {
    let mut costs = task.operators().iter().map(|o| o.cost);
    let first = costs.next().unwrap_or(1);
    if first > 0 && costs.all(|cost| cost == first) { Costs::Real } else { Costs::PlusOne }
}

/// The order of each search: the first is greedy, the others weight the estimate.
const ORDERS: [Order; 5] =
    [Order::Greedy, Order::Weighted(5), Order::Weighted(3), Order::Weighted(2), Order::Weighted(1)];

/// Runs searches below the bound, one after the other.
pub(crate) struct Improving<'a> {
    job: Job<'a>,
    costs: Costs,
    stage: usize,
    search: Lazy<'a>,
    before: Statistics,
}

impl<'a> Improving<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        let costs = counted(job.task);
        Self { job, costs, stage: 0, search: Self::stage(job, costs, 0), before: Statistics::default() }
    }

    fn stage(job: Job<'a>, costs: Costs, stage: usize) -> Lazy<'a> {
        const BOTH: &[HeuristicKind] = &[HeuristicKind::Ff, HeuristicKind::Landmarks];
        let (order, pruning) = (ORDERS[stage], Pruning::Spent);
        Lazy::new(
            job,
            &LazySettings { heuristics: BOTH, preferred: BOTH, costs, order, explorations: &[], pruning },
        )
    }

    /// Starts the next search. Returns whether there was one.
    fn next(&mut self) -> bool {
        if self.stage + 1 == ORDERS.len() {
            return false;
        }
        self.before += self.search.statistics();
        self.stage += 1;
        self.search = Self::stage(self.job, self.costs, self.stage);
        true
    }
}

impl Searcher for Improving<'_> {
    fn advance(&mut self, turn: &Turn) -> Option<Outcome> {
        loop {
            let expansions = turn.expansions.saturating_sub(self.before.expanded);
            match self.search.advance(&Turn { expansions, ..*turn })? {
                Outcome::Solved(plan) => {
                    self.next();
                    return Some(Outcome::Solved(plan));
                }
                // The next search starts with no states and takes other paths.
                Outcome::LimitReached(limit @ (Limit::Incomplete | Limit::Memory)) => {
                    if !self.next() {
                        return Some(Outcome::LimitReached(limit));
                    }
                }
                other => return Some(other),
            }
        }
    }

    fn statistics(&self) -> Statistics {
        self.before + self.search.statistics()
    }
}

//! hmax: the cost of the most expensive proposition of the goal. A comparison of numbers costs at
//! least what it lacks times the lowest price of a unit. Admissible (with real costs), consistent,
//! safe.
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001, §4.

use super::{Combine, Costs, Estimate, Explorer, Heuristic, View};
use crate::heuristics::Job;
use crate::ids::OperatorId;

pub(crate) struct Max<'a> {
    explorer: Explorer<'a>,
}

impl<'a> Max<'a> {
    pub(crate) fn new(job: &Job<'a>, costs: Costs) -> Self {
        let goal = job.task.relaxation.literals(&job.goal.literals);
        Self { explorer: Explorer::new(job, goal, costs, Combine::Max) }
    }
}

impl Heuristic for Max<'_> {
    fn estimate(&mut self, view: &View<'_>, _: Option<&mut Vec<OperatorId>>) -> Estimate {
        let words = view.words;
        if !self.explorer.explore(words) {
            return Estimate::DEAD_END;
        }
        let costs = self.explorer.goal().iter().map(|&p| self.explorer.cost(p));
        Estimate(costs.max().unwrap_or(0))
    }
}

//! hadd: the sum of the costs of the goal's propositions in the delete relaxation, as if they were
//! independent. A comparison of numbers costs as many repetitions of an operator as it needs.
//! Neither admissible nor consistent; safe.
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001, §3.

use super::{Combine, Costs, Estimate, Explorer, Heuristic, View};
use crate::heuristics::Job;
use crate::ids::OperatorId;

pub(crate) struct Add<'a> {
    explorer: Explorer<'a>,
}

impl<'a> Add<'a> {
    pub(crate) fn new(job: &Job<'a>, costs: Costs) -> Self {
        let goal = job.task.relaxation.literals(&job.goal.literals);
        Self { explorer: Explorer::new(job, goal, costs, Combine::Sum) }
    }
}

impl Heuristic for Add<'_> {
    fn estimate(&mut self, view: &View<'_>, _: Option<&mut Vec<OperatorId>>) -> Estimate {
        if !self.explorer.explore(view.words) {
            return Estimate::DEAD_END;
        }
        let costs = self.explorer.goal().iter().map(|&p| self.explorer.cost(p));
        Estimate(costs.fold(0, u32::saturating_add).min(u32::MAX - 1))
    }
}

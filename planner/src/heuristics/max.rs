//! hmax: the dearest proposition of the goal. Admissible (with real costs), consistent, safe.
//!
//! Source: Bonet & Geffner, "Planning as heuristic search", AIJ 2001, §4.

use super::{Combine, Costs, Estimate, Explorer, Heuristic};
use crate::ids::{OperatorId, StateId};
use crate::search::Barred;
use crate::task::{Goal, Task};

pub(crate) struct Max<'t> {
    explorer: Explorer<'t>,
}

impl<'t> Max<'t> {
    pub(crate) fn new(task: &'t Task, goal: &Goal, barred: &Barred, costs: Costs) -> Self {
        let goal = task.relaxation.literals(&goal.literals);
        Self { explorer: Explorer::new(task, goal, barred, costs, Combine::Max) }
    }
}

impl Heuristic for Max<'_> {
    fn estimate(&mut self, _: StateId, words: &[u64], _: &[OperatorId], _: &mut Vec<OperatorId>) -> Estimate {
        if !self.explorer.explore(words) {
            return Estimate::DEAD_END;
        }
        let costs = self.explorer.goal().iter().map(|&p| self.explorer.cost(p));
        Estimate(costs.max().unwrap_or(0))
    }
}

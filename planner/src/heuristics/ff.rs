//! hFF: the cost of a relaxed plan, with the operators that begin it as preferred ones.
//!
//! Idea: supporters chosen by hadd; walking them back from the goal gives a plan of the relaxation,
//! whose applicable operators are the ones worth trying first. Neither admissible nor consistent;
//! safe. Cost: one exploration plus the plan.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §4; supporters by hadd: Keyder &
//! Geffner, "Heuristics for planning with action costs revisited", ECAI 2008.

use super::explorer::UNREACHED;
use super::{Combine, Costs, Estimate, Explorer, Heuristic};
use crate::ids::{OperatorId, StateId};
use crate::search::Barred;
use crate::task::{AXIOM, Goal, Task};

pub(crate) struct Ff<'t> {
    task: &'t Task,
    costs: Costs,
    explorer: Explorer<'t>,
    /// Generation in which a proposition or operator was last marked.
    marked: Vec<u32>,
    used: Vec<u32>,
    generation: u32,
    stack: Vec<u32>,
    /// What the last relaxed plan achieves.
    achieved: Vec<u32>,
}

impl<'t> Ff<'t> {
    pub(crate) fn new(task: &'t Task, goal: &Goal, barred: &Barred, costs: Costs) -> Self {
        let goal = task.relaxation.literals(&goal.literals);
        let explorer = Explorer::new(task, goal, barred, costs, Combine::Sum);
        Self {
            marked: vec![0; task.relaxation.propositions()],
            used: vec![0; task.operators.len()],
            generation: 0,
            stack: Vec::new(),
            achieved: Vec::new(),
            task,
            costs,
            explorer,
        }
    }

    /// The length or cost of a relaxed plan from the state.
    pub(crate) fn relaxed_plan(&mut self, words: &[u64], preferred: &mut Vec<OperatorId>) -> Estimate {
        self.achieved.clear();
        if !self.explorer.explore(words) {
            return Estimate::DEAD_END;
        }
        self.generation += 1;
        let (generation, graph) = (self.generation, self.explorer.graph());
        let mut total = 0_u32;
        self.stack.extend_from_slice(self.explorer.goal());
        while let Some(p) = self.stack.pop() {
            if std::mem::replace(&mut self.marked[p as usize], generation) == generation {
                continue;
            }
            let node = self.explorer.supporter(p);
            if node == UNREACHED {
                continue;
            }
            self.achieved.push(p);
            self.stack.extend_from_slice(graph.preconditions.row(node));
            let number = graph.operator[node as usize];
            if number == AXIOM || std::mem::replace(&mut self.used[number as usize], generation) == generation
            {
                continue;
            }
            let operator = &self.task.operators.as_slice()[number as usize];
            let cost = if self.costs == Costs::Unit { 1 } else { operator.cost };
            total = total.saturating_add(cost);
            if self.explorer.is_ready(node) && operator.precondition.hold_in(words) {
                preferred.push(OperatorId(number));
            }
        }
        Estimate(total.min(u32::MAX - 1))
    }

    /// The propositions that the last relaxed plan achieves.
    pub(crate) fn achieved(&self) -> &[u32] {
        &self.achieved
    }
}

impl Heuristic for Ff<'_> {
    fn estimate(
        &mut self,
        _: StateId,
        words: &[u64],
        _: &[OperatorId],
        preferred: &mut Vec<OperatorId>,
    ) -> Estimate {
        self.relaxed_plan(words, preferred)
    }
}

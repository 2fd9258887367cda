//! hFF: the cost of a relaxed plan; its first operators are the preferred ones.
//!
//! Idea: choose supporters by hadd and follow them back from the goal. The result is a plan of the
//! relaxation; its applicable operators are the helpful ones. Neither admissible nor consistent;
//! safe. If numbers require repetitions, the plan is a counted one (`counted_plan`). Cost: one
//! exploration plus the plan.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §4; supporters by hadd: Keyder &
//! Geffner, "Heuristics for planning with action costs revisited", ECAI 2008.

use super::counted_plan::{CountedPlan, Walk};
use super::explorer::UNREACHED;
use super::{Combine, Costs, Estimate, Explorer, Heuristic, View};
use crate::heuristics::Job;
use crate::ids::OperatorId;
use crate::task::{AXIOM, Task};

pub(crate) struct Ff<'a> {
    task: &'a Task,
    costs: Costs,
    explorer: Explorer<'a>,
    /// Set if operators may have to be repeated.
    counted: Option<CountedPlan>,
    /// The generation in which a proposition or operator was last marked; empty if `counted` is
    /// set.
    marked: Vec<u32>,
    used: Vec<u32>,
    generation: u32,
    stack: Vec<u32>,
    /// The propositions that the last relaxed plan achieves.
    achieved: Vec<u32>,
    /// The real cost of the last relaxed plan.
    real: u64,
}

impl<'a> Ff<'a> {
    pub(crate) fn new(job: &Job<'a>, costs: Costs) -> Self {
        let task = job.task;
        let goal = task.relaxation.literals(&job.goal.literals);
        let explorer = Explorer::new(job, goal, costs, Combine::Sum);
        let counted = CountedPlan::new(task);
        let marks = |count: usize| vec![0; if counted.is_some() { 0 } else { count }];
        Self {
            marked: marks(task.relaxation.propositions()),
            used: marks(task.operators.len()),
            counted,
            generation: 0,
            stack: Vec::new(),
            achieved: Vec::new(),
            real: 0,
            task,
            costs,
            explorer,
        }
    }

    /// Returns the length or cost of a relaxed plan from the state.
    pub(crate) fn relaxed_plan(
        &mut self,
        words: &[u64],
        mut preferred: Option<&mut Vec<OperatorId>>,
    ) -> Estimate {
        self.achieved.clear();
        self.real = 0;
        if !self.explorer.explore(words) {
            return Estimate::DEAD_END;
        }
        if let Some(counted) = &mut self.counted {
            let walk = Walk { task: self.task, explorer: &self.explorer, costs: self.costs, words };
            let estimate = counted.walk(&walk, &mut self.achieved, preferred);
            self.real = counted.real();
            return estimate;
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
            let operator = self.task.operator(OperatorId(number));
            total = total.saturating_add(self.costs.of(operator.cost));
            self.real += u64::from(operator.cost);
            let Some(preferred) = preferred.as_deref_mut() else { continue };
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
    fn estimate(&mut self, view: &View<'_>, preferred: Option<&mut Vec<OperatorId>>) -> Estimate {
        self.relaxed_plan(view.words, preferred)
    }

    fn rest(&self) -> u64 {
        self.real
    }
}

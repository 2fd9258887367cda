//! A monitored plan.

use super::deviation::{BrokenLiteral, Deviation};
use super::kernels::{Kernels, Literal};
use crate::Model;
use planner::{FactId, Goal, Kernel, OperatorId, State, Task};

/// A plan, the suffix of it that still reaches the goal, and the reasons where none does.
#[derive(Clone, Debug)]
pub struct Monitor {
    plan: Vec<OperatorId>,
    goal: Goal,
    method: Method,
}

#[derive(Clone, Debug)]
enum Method {
    /// Kernels, exact where regression is.
    Regressed(Kernels),
    /// Progression of the state through each suffix: exact for every feature, linear in the plan per suffix.
    Simulated,
}

impl Monitor {
    /// Monitors `plan` for `goal`, starting from `state`. The plan must be valid there: kernels do not notice a step that
    /// takes away what a later one needs.
    pub fn new(task: &Task, plan: Vec<OperatorId>, goal: Goal, state: &State) -> Self {
        let method = if Kernel::is_exact(task, &plan) {
            Method::Regressed(Kernels::new(task, &plan, &goal, state))
        } else {
            Method::Simulated
        };
        Self { plan, goal, method }
    }

    /// The plan.
    pub fn plan(&self) -> &[OperatorId] {
        &self.plan
    }

    /// Facts of the state changed: those in `changes` now have the given truth.
    pub fn change(&mut self, changes: &[(FactId, bool)]) {
        if let Method::Regressed(kernels) = &mut self.method {
            for &(fact, now) in changes {
                kernels.change(fact, now);
            }
        }
    }

    /// The last suffix of the plan that reaches the goal from `state`, as the number of steps it leaves
    /// out; the plan's length if the goal holds. `None`: no suffix does.
    pub fn furthest(&self, task: &Task, state: &State) -> Option<usize> {
        match &self.method {
            Method::Regressed(kernels) => kernels.furthest(),
            Method::Simulated => {
                (0..=self.plan.len()).rev().find(|&start| self.reaches_goal(task, state, start))
            }
        }
    }

    fn reaches_goal(&self, task: &Task, state: &State, start: usize) -> bool {
        task.after(state, &self.plan[start..]).is_some_and(|end| task.satisfies(&end, &self.goal))
    }

    /// Why the suffix that starts at `current` does not reach the goal from `state`.
    pub fn deviation(&self, model: &Model, state: &State, current: usize) -> Deviation {
        let broken = match &self.method {
            Method::Regressed(kernels) => kernels
                .condition(current)
                .iter()
                .filter(|&&(fact, positive)| state.contains(fact) != positive)
                .map(|&literal| self.explain(model, current, literal))
                .collect(),
            Method::Simulated => self.first_failure(model, state, current),
        };
        Deviation { broken }
    }

    /// The unsatisfied literals of the first step that cannot be applied, or of the goal.
    fn first_failure(&self, model: &Model, state: &State, current: usize) -> Vec<BrokenLiteral> {
        let task = model.task();
        let mut state = state.clone();
        for &operator in &self.plan[current..] {
            let precondition = task.operator(operator).precondition;
            let Some(next) = task.successor(&state, operator) else {
                return self.unsatisfied(model, current, precondition, &state);
            };
            state = next;
        }
        self.unsatisfied(model, current, self.goal.literals.as_ref(), &state)
    }

    fn unsatisfied(
        &self,
        model: &Model,
        current: usize,
        literals: planner::LiteralsRef<'_>,
        state: &State,
    ) -> Vec<BrokenLiteral> {
        let positive = literals.positive.iter().map(|&fact| (fact, true));
        let negative = literals.negative.iter().map(|&fact| (fact, false));
        positive
            .chain(negative)
            .filter(|&(fact, wanted)| state.contains(fact) != wanted)
            .map(|literal| self.explain(model, current, literal))
            .collect()
    }

    /// The step that needs the literal, and the step that was to give it.
    fn explain(&self, model: &Model, current: usize, (fact, positive): Literal) -> BrokenLiteral {
        let operators = model.task().operators();
        let needs = |&&operator: &&OperatorId| {
            let precondition = operators.get(operator).precondition;
            let among = if positive { precondition.positive } else { precondition.negative };
            among.contains(&fact)
        };
        let gives = |&&operator: &&OperatorId| {
            let among = if positive { operators.get(operator).adds } else { operators.get(operator).deletes };
            among.contains(&fact)
        };
        BrokenLiteral {
            fact: model.name(fact),
            expected: positive,
            needed_by: self.plan[current..].iter().find(needs).map(|&o| model.step(o)),
            given_by: self.plan[..current].iter().rfind(gives).map(|&o| model.step(o)),
            seen: Vec::new(),
        }
    }
}

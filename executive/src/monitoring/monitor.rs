//! A monitored plan.

use super::deviation::{BrokenLiteral, Deviation};
use crate::Model;
use planner::{FactId, Goal, LiteralsRef, OperatorId, State, Suffixes, Task};

/// A plan, the suffix of it that still reaches the goal, and the reasons where none does.
#[derive(Clone, Debug)]
pub struct Monitor {
    suffixes: Suffixes,
    goal: Goal,
}

impl Monitor {
    /// Monitors `plan` for `goal`, starting from `state`.
    pub fn new(task: &Task, plan: Vec<OperatorId>, goal: Goal, state: &State) -> Self {
        Self { suffixes: Suffixes::new(task, plan, goal.clone(), state), goal }
    }

    /// The plan.
    pub fn plan(&self) -> &[OperatorId] {
        self.suffixes.plan()
    }

    /// Takes in the state as it is now. Everything else that a monitor answers is about the state last observed.
    pub fn observe(&mut self, task: &Task, state: &State) {
        self.suffixes.observe(task, state);
    }

    /// The last suffix of the plan that reaches the goal, as the number of steps it leaves out; the plan's length if the
    /// goal holds. `None`: no suffix does.
    pub fn furthest(&self, task: &Task) -> Option<usize> {
        self.suffixes.furthest(task)
    }

    /// The first suffix that is not simulated; 0 where regression is exact for the whole plan.
    pub fn exact_from(&self) -> usize {
        self.suffixes.exact_from()
    }

    /// Why the suffix that starts at `current` does not reach the goal from `state`, the state last observed: the
    /// literals that it needs and does not find. Where it needs one of several, the literals of the first step that
    /// cannot be applied are named instead.
    pub fn deviation(&self, model: &Model, state: &State, current: usize) -> Deviation {
        if self.suffixes.reaches(model.task(), current) {
            return Deviation::default();
        }
        let (mut broken, all) = self.suffixes.broken(current);
        if !all {
            broken.extend(self.first_failure(model.task(), state, current));
            broken.sort_unstable();
            broken.dedup();
        }
        Deviation {
            broken: broken.into_iter().map(|literal| self.explain(model, current, literal)).collect(),
        }
    }

    /// The unsatisfied literals of the first step that cannot be applied, or of the goal.
    fn first_failure(&self, task: &Task, state: &State, current: usize) -> Vec<(FactId, bool)> {
        let mut state = state.clone();
        for &operator in &self.plan()[current..] {
            let Some(next) = task.ways(operator).find_map(|way| task.successor(&state, way)) else {
                return unsatisfied(task.operator(operator).precondition, &state);
            };
            state = next;
        }
        unsatisfied(self.goal.literals.as_ref(), &state)
    }

    /// The step that needs the literal, and the step that was to give it.
    fn explain(&self, model: &Model, current: usize, (fact, positive): (FactId, bool)) -> BrokenLiteral {
        let operators = model.task().operators();
        let among = |(if_positive, if_negative): (&[FactId], &[FactId])| {
            (if positive { if_positive } else { if_negative }).contains(&fact)
        };
        let needs = |&&operator: &&OperatorId| {
            let LiteralsRef { positive, negative } = operators.get(operator).precondition;
            among((positive, negative))
        };
        let gives = |&&operator: &&OperatorId| {
            let operator = operators.get(operator);
            among((operator.adds, operator.deletes))
                || operator.conditional.iter().any(|effect| among((effect.adds, effect.deletes)))
        };
        let plan = self.plan();
        BrokenLiteral {
            fact: model.name(fact),
            comparison: model.comparison(fact),
            expected: positive,
            needed_by: plan[current..].iter().find(needs).map(|&o| model.step(o)),
            given_by: plan[..current].iter().rfind(gives).map(|&o| model.step(o)),
            seen: Vec::new(),
        }
    }
}

fn unsatisfied(literals: LiteralsRef<'_>, state: &State) -> Vec<(FactId, bool)> {
    literals.iter().filter(|&(fact, wanted)| state.contains(fact) != wanted).collect()
}

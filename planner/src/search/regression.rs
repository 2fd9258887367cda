//! What must hold before steps for them to be done and to end in a goal.
//!
//! Idea: from the back, what a step gives is taken out of what is wanted, and what it needs is added. What axioms,
//! numbers and conditional effects need is not followed back, and neither is it seen where a step takes away what is
//! wanted after it, so whoever needs a plan replays it. Invariant: where there are no axioms, numbers and conditional
//! effects, the kernel of a suffix holds wherever the suffix reaches the goal; the other way round, too, if the suffix
//! is the end of some plan for that goal. Cost: a step is
//! linear in the kernel, times a search in the step's effects.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972.

use crate::ids::{FactId, OperatorId};
use crate::task::{Literals, LiteralsRef, State, Task};
use std::collections::BTreeMap;

/// What must hold now for the steps so far to reach the goal.
pub(crate) struct Kernel<'a> {
    task: &'a Task,
    wanted: BTreeMap<FactId, bool>,
}

impl<'a> Kernel<'a> {
    /// Before no step: the goal.
    pub(crate) fn new(task: &'a Task, goal: &Literals) -> Self {
        let mut kernel = Self { task, wanted: BTreeMap::new() };
        kernel.require(goal.as_ref());
        kernel
    }

    /// Before a step that comes before those so far.
    pub(crate) fn before(&mut self, step: OperatorId) {
        let (task, operator) = (self.task, self.task.operator(step));
        self.wanted.retain(|fact, wanted| {
            let given = if *wanted { operator.adds } else { operator.deletes };
            // Axioms and numbers decide anew after each step.
            given.binary_search(fact).is_err() && !task.facts()[*fact].derived
        });
        self.require(operator.precondition);
    }

    fn require(&mut self, literals: LiteralsRef<'_>) {
        self.wanted.extend(literals.positive.iter().map(|&fact| (fact, true)));
        self.wanted.extend(literals.negative.iter().map(|&fact| (fact, false)));
    }

    /// How much of it does not hold in a state.
    pub(crate) fn missing(&self, state: &State) -> usize {
        self.wanted.iter().filter(|&(&fact, &wanted)| state.contains(fact) != wanted).count()
    }

    /// The same as a goal's literals.
    pub(crate) fn literals(&self) -> Literals {
        let of = |wanted| self.wanted.iter().filter(move |&(_, &own)| own == wanted).map(|(&fact, _)| fact);
        Literals { positive: of(true).collect(), negative: of(false).collect() }
    }
}

//! The kernel of steps: the literals that must hold before them, as the goal of a search.
//!
//! Idea: go through the steps from the last to the first. Each step removes the literals that it
//! achieves from the condition and adds its precondition.
//!
//! Axioms and numbers are evaluated again after each step. A derived fact is therefore dropped from
//! the condition before a step: the basic facts that it depends on are not regressed. A comparison
//! of numbers is dropped only before a step that changes numbers; any other step keeps it as it is.
//! Conditional effects are not regressed, and a step that deletes a wanted fact is not detected. A
//! caller that needs a valid plan must therefore replay it. [`Suffixes`](super::Suffixes) is exact.
//!
//! Cost: a step is linear in the kernel, times a search in the step's effects.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972.

use super::super::{Literals, LiteralsRef, State, Task};
use crate::ids::{FactId, OperatorId};
use std::collections::BTreeMap;

/// The condition that must hold now so that the steps reach the goal.
#[derive(Clone, Debug)]
pub(crate) struct Kernel<'a> {
    task: &'a Task,
    wanted: BTreeMap<FactId, bool>,
}

impl<'a> Kernel<'a> {
    /// The kernel before no steps: the goal.
    pub(crate) fn new(task: &'a Task, goal: &Literals) -> Self {
        let mut kernel = Self { task, wanted: BTreeMap::new() };
        kernel.require(goal.as_ref());
        kernel
    }

    /// Regresses through a step that precedes those so far.
    pub(crate) fn before(&mut self, step: OperatorId) {
        let (task, operator) = (self.task, self.task.operator(step));
        self.wanted.retain(|fact, wanted| {
            let given = if *wanted { operator.adds } else { operator.deletes };
            let own = &task.facts()[*fact];
            let decided_anew = own.derived && (!own.compares || operator.changes_numbers());
            !decided_anew && given.binary_search(fact).is_err()
        });
        self.require(operator.precondition);
    }

    fn require(&mut self, literals: LiteralsRef<'_>) {
        self.wanted.extend(literals.iter());
    }

    /// The literals of the kernel: each fact with whether it must hold, in order of facts.
    fn iter(&self) -> impl Iterator<Item = (FactId, bool)> {
        self.wanted.iter().map(|(&fact, &wanted)| (fact, wanted))
    }

    /// The number of its literals that do not hold in a state.
    pub(crate) fn missing(&self, state: &State) -> usize {
        self.iter().filter(|&(fact, wanted)| state.contains(fact) != wanted).count()
    }

    /// The kernel as literals of a goal.
    pub(crate) fn literals(&self) -> Literals {
        let of = |wanted| self.iter().filter(move |&(_, own)| own == wanted).map(|(fact, _)| fact);
        Literals { positive: of(true).collect(), negative: of(false).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::Kernel;
    use crate::test_support::Grounded;
    use crate::{Task, ids::OperatorId};

    /// A pump that needs a level, and a lamp that an axiom derives.
    fn task() -> Grounded {
        let domain = "(define (domain d) (:requirements :strips :numeric-fluents :derived-predicates)
            (:predicates (on) (done) (wired) (lit)) (:functions (level))
            (:derived (lit) (and (on) (wired)))
            (:action wire :parameters () :precondition () :effect (wired))
            (:action turn :parameters () :precondition () :effect (on))
            (:action fill :parameters () :precondition () :effect (increase (level) 1))
            (:action pump :parameters () :precondition (and (lit) (>= (level) 2)) :effect (done)))";
        let problem = "(define (problem p) (:domain d) (:init (= (level) 0)) (:goal (done)))";
        Grounded::new((domain.to_owned(), problem.to_owned()))
    }

    fn step(task: &Task, name: &str) -> OperatorId {
        task.operators().ids().find(|&o| task.operator_name(o) == name).unwrap()
    }

    fn after(names: &[&str]) -> Vec<String> {
        let task = &task().task;
        let mut kernel = Kernel::new(task, &task.goal().literals);
        names.iter().rev().for_each(|name| kernel.before(step(task, name)));
        kernel.iter().map(|(fact, _)| task.fact_name(fact)).collect()
    }

    #[test]
    fn a_comparison_stays_wanted_until_a_step_changes_numbers() {
        assert_eq!(after(&["(pump)"]).len(), 2);
        assert_eq!(after(&["(turn)", "(pump)"]).len(), 1, "the derived fact is decided anew");
        assert_eq!(after(&["(fill)", "(pump)"]).len(), 0);
    }
}

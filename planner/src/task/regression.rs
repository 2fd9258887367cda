//! What must hold before steps for them to be done and to end in a goal.
//!
//! Idea: from the back, what a step gives is taken out of what is wanted, and what it needs is added. Repair, the
//! windows of a plan and the executive's monitoring all regress through this one type.
//!
//! Axioms and numbers decide anew after each step. So a wanted fact that an axiom derives is dropped before a step,
//! for which facts it depends on is not followed back; a wanted comparison of numbers is dropped only before a step
//! that changes numbers, since any other step leaves it as it is. Conditional effects are not followed back, and a
//! step that takes away what is wanted after it is not noticed. A caller that needs a plan therefore replays it.
//!
//! Invariant: where [`Kernel::is_exact`], and the steps are a suffix of some valid plan for that goal, the kernel of the
//! steps holds exactly in the states from which they reach the goal. Cost: a step is linear in the kernel, times a search in the step's effects.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972.

use super::grounded::Task;
use super::literals::{Literals, LiteralsRef};
use super::state::State;
use crate::ids::{FactId, OperatorId};
use std::collections::BTreeMap;

/// What must hold now for the steps so far to reach the goal.
#[derive(Clone, Debug)]
pub struct Kernel<'a> {
    task: &'a Task,
    wanted: BTreeMap<FactId, bool>,
}

impl<'a> Kernel<'a> {
    /// Before no step: the goal.
    pub fn new(task: &'a Task, goal: &Literals) -> Self {
        let mut kernel = Self { task, wanted: BTreeMap::new() };
        kernel.require(goal.as_ref());
        kernel
    }

    /// Whether regression through these steps loses nothing: no axioms, no conditional effects, no changes of numbers.
    pub fn is_exact(task: &Task, steps: &[OperatorId]) -> bool {
        let regresses = |&step: &OperatorId| {
            let operator = task.operator(step);
            operator.conditional.is_empty() && !operator.changes_numbers()
        };
        task.axioms().is_empty() && steps.iter().all(regresses)
    }

    /// Goes to before a step that comes before those so far.
    pub fn before(&mut self, step: OperatorId) {
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
        self.wanted.extend(literals.positive.iter().map(|&fact| (fact, true)));
        self.wanted.extend(literals.negative.iter().map(|&fact| (fact, false)));
    }

    /// Each fact with whether it must hold, in order of facts.
    pub fn iter(&self) -> impl Iterator<Item = (FactId, bool)> {
        self.wanted.iter().map(|(&fact, &wanted)| (fact, wanted))
    }

    /// How many of its literals do not hold in a state.
    pub(crate) fn missing(&self, state: &State) -> usize {
        self.iter().filter(|&(fact, wanted)| state.contains(fact) != wanted).count()
    }

    /// The same as a goal's literals.
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

    /// A pump that needs a level, a lamp that an axiom derives.
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

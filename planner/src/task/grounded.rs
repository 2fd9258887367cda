//! A grounded task: its parts, its states, and single steps.
//!
//! Invariant: a [`State`] that a task creates is closed under its axioms.

use super::atoms::AtomTable;
use super::axioms::{AxiomProgram, AxiomRule};
use super::fact::{AtomStatus, Fact};
use super::goal::Goal;
use super::metric::Metric;
use super::mutexes::{Mutexes, Variable};
use super::names::Names;
use super::numeric::Numeric;
use super::operator::Operator;
use super::operators::Operators;
use super::packing::Packing;
use super::relaxation::Relaxation;
use super::state::{State, set, unset};
use super::successors::SuccessorTree;
use super::ways::Ways;
use crate::ids::{FactId, OperatorId};
use pddl::model::{IndexVec, ObjectId, PredicateId};
use std::sync::OnceLock;

/// A grounded task.
#[derive(Clone, Debug)]
pub struct Task {
    pub(crate) facts: IndexVec<FactId, Fact>,
    pub(crate) operators: Operators,
    pub(crate) axioms: AxiomProgram,
    pub(crate) initial: State,
    pub(crate) goal: Goal,
    pub(crate) atoms: AtomTable,
    pub(crate) status: Vec<AtomStatus>,
    pub(crate) names: Names,
    pub(crate) cost_scale: u32,
    pub(crate) mutexes: Mutexes,
    pub(crate) variables: Vec<Variable>,
    pub(crate) numeric: Numeric,
    /// `None` if the metric is a sum of operator costs.
    pub(crate) metric: Option<Metric>,
    pub(crate) packing: Option<Packing>,
    pub(crate) successors: SuccessorTree,
    pub(crate) relaxation: Relaxation,
    /// The relaxation without dominated effects.
    pub(crate) undominated: Relaxation,
    /// Made when it is first asked for: few callers do.
    pub(crate) ways: OnceLock<Ways>,
}

impl Task {
    /// All facts, including derived ones.
    pub fn facts(&self) -> &IndexVec<FactId, Fact> {
        &self.facts
    }

    /// All operators.
    pub fn operators(&self) -> &Operators {
        &self.operators
    }

    /// One operator.
    pub fn operator(&self, operator: OperatorId) -> Operator<'_> {
        self.operators.get(operator)
    }

    /// All rules of axioms.
    pub fn axioms(&self) -> &[AxiomRule] {
        self.axioms.rules()
    }

    /// Groups of facts of which at most one holds.
    pub fn mutexes(&self) -> &Mutexes {
        &self.mutexes
    }

    /// Finite-domain variables: each basic fact is a value of one of them.
    pub fn variables(&self) -> &[Variable] {
        &self.variables
    }

    /// The initial state.
    pub fn initial_state(&self) -> &State {
        &self.initial
    }

    /// The problem's goal.
    pub fn goal(&self) -> &Goal {
        &self.goal
    }

    /// The costs of operators are in units of `1 / cost_scale`.
    pub fn cost_scale(&self) -> u32 {
        self.cost_scale
    }

    /// The status of a ground atom.
    pub fn status(&self, predicate: PredicateId, arguments: &[ObjectId]) -> AtomStatus {
        self.atoms
            .find(predicate, arguments.iter().map(|o| o.0))
            .map_or(AtomStatus::NeverTrue, |atom| self.status[atom as usize])
    }

    /// The fact of a ground atom, if it is one.
    pub fn fact(&self, predicate: PredicateId, arguments: &[ObjectId]) -> Option<FactId> {
        match self.status(predicate, arguments) {
            AtomStatus::Fact(fact) => Some(fact),
            _ => None,
        }
    }

    /// The state in which exactly these basic facts hold. Derived facts follow from the axioms
    /// (listed ones are ignored). Numbers have their initial values.
    pub fn state(&self, facts: impl IntoIterator<Item = FactId>) -> State {
        let mut state = State::empty(self.facts.len(), self.numeric.words());
        let fit = self.numeric.initialise(state.words_mut());
        state.note_fit(fit);
        for fact in facts {
            if !self.facts[fact].derived {
                state.insert(fact);
            }
        }
        self.axioms.close(state.words_mut());
        state
    }

    /// Sets the truth of basic facts, and derives the others again (listed ones are ignored). Returns
    /// whether a basic fact changed. Cost: linear in the words of a state, plus the axioms that read
    /// what changed.
    pub fn change(&self, state: &mut State, changes: impl IntoIterator<Item = (FactId, bool)>) -> bool {
        let before = (!self.axioms.is_empty()).then(|| state.clone());
        let mut changed = false;
        for (fact, now) in changes {
            if !self.facts[fact].derived && state.contains(fact) != now {
                let change = if now { set } else { unset };
                change(state.words_mut(), fact);
                changed = true;
            }
        }
        if let Some(before) = before.filter(|_| changed) {
            self.axioms.update(before.words(), state.words_mut());
        }
        changed
    }

    /// The operator, then the other operators of its action and arguments: each stands for another
    /// way to satisfy the action's precondition.
    pub fn ways(&self, operator: OperatorId) -> impl Iterator<Item = OperatorId> + '_ {
        self.ways.get_or_init(|| Ways::of(&self.operators)).get(operator)
    }

    /// Whether the operator's precondition holds.
    pub fn is_applicable(&self, state: &State, operator: OperatorId) -> bool {
        self.operator(operator).precondition.hold_in(state.words())
    }

    /// The state after an operator; `None` if the operator is not applicable or a number does not
    /// fit.
    pub fn successor(&self, state: &State, operator: OperatorId) -> Option<State> {
        if !self.is_applicable(state, operator) {
            return None;
        }
        let mut next = state.clone();
        self.apply(operator, state.words(), next.words_mut()).then_some(next)
    }

    /// The state after a sequence of operators; `None` if [`Task::successor`] of one of them is
    /// `None`.
    pub fn after(&self, state: &State, operators: &[OperatorId]) -> Option<State> {
        operators.iter().try_fold(state.clone(), |state, &operator| self.successor(&state, operator))
    }

    /// All applicable operators, in a fixed order.
    pub fn applicable(&self, state: &State) -> Vec<OperatorId> {
        let mut found = Vec::new();
        self.successors.applicable(state.words(), &mut found);
        found
    }

    /// Whether the goal holds.
    pub fn satisfies(&self, state: &State, goal: &Goal) -> bool {
        goal.holds_in(state.words())
    }

    /// Turns `next`, a copy of `state`, into the successor. Returns `false` if a number does not
    /// fit; `next` is then invalid.
    #[must_use]
    pub(crate) fn apply(&self, operator: OperatorId, state: &[u64], next: &mut [u64]) -> bool {
        let own = self.operator(operator);
        own.apply(state, next);
        if let Some(effects) = own.numeric
            && !self.numeric.apply(effects, state, next)
        {
            return false;
        }
        self.axioms.update(state, next);
        true
    }

    /// The approximate bytes that the task holds.
    pub fn memory_bytes(&self) -> usize {
        self.operators.memory_bytes()
            + self.successors.memory_bytes()
            + self.relaxation.memory_bytes()
            + self.undominated.memory_bytes()
            + self.facts.len() * (size_of::<Fact>() + 32)
            + self.status.len() * 100
    }

    /// The number of words of a state.
    pub(crate) fn words_per_state(&self) -> usize {
        self.initial.words().len()
    }
}

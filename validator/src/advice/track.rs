//! One state that moves along a plan, forward by executing steps and backward by undoing them.
//!
//! Problem: most repairs touch a few steps near the failure, and executing the whole plan for each candidate costs
//! its full length. Idea: the state stays near the failure. Each executed step records its changes, so that it can be
//! undone. A changed plan is executed from its first new step up to the first inapplicable one, and undone for the
//! next candidate.
//!
//! Invariant: after [`Track::go_to`] the state is the one before the step with that number. A moment is never used
//! twice, so an add of an earlier trial cannot override a delete.
//!
//! Cost: the steps between a change and the first inapplicable step after it. Trajectory constraints are not checked
//! here: a candidate that passes is validated as a whole afterwards.

use super::edit::Edit;
use crate::effect::Changes;
use crate::prepared::Prepared;
use crate::reads::each_guard;
use crate::relation::Moment;
use crate::scene::{Binding, Clock};
use crate::state::State;
use crate::trace::Diff;
use crate::work::Work;
use pddl::PlanStep;

/// A plan's states, one at a time.
pub(super) struct Track<'t, 'a> {
    pub(super) prepared: &'t Prepared<'a>,
    pub(super) steps: &'t [PlanStep],
    state: State,
    /// The changes of each executed step.
    taken: Vec<Diff>,
    /// How many of them are steps of the original plan.
    own: usize,
    moment: Moment,
    changes: Changes,
    binding: Binding,
    /// How many steps may still be executed.
    pub(super) left: usize,
}

impl<'t, 'a> Track<'t, 'a> {
    pub(super) fn new(prepared: &'t Prepared<'a>, steps: &'t [PlanStep], left: usize) -> Self {
        let mut state = State::empty(prepared.domain, &vec![true; prepared.domain.predicates.len()]);
        // All trials share one budget.
        state.work = Work::for_steps(steps.len());
        for (predicate, relation) in prepared.initial.facts.enumerate() {
            for arguments in relation.holding() {
                state.facts[predicate].add(arguments, 0);
            }
        }
        for (fluent, value) in prepared.initial.fluents() {
            state.set_fluent(fluent.clone(), Some(value));
        }
        Self {
            prepared,
            steps,
            state,
            taken: Vec::new(),
            own: 0,
            moment: 0,
            changes: Changes::default(),
            binding: Binding::default(),
            left,
        }
    }

    /// The state with its derived atoms.
    pub(super) fn state(&mut self) -> &State {
        self.moment += 1;
        self.prepared.derive(&mut self.state, self.moment);
        &self.state
    }

    /// The changes of the executed steps.
    pub(super) fn taken(&self) -> &[Diff] {
        &self.taken
    }

    /// Goes to the state before the plan's step at `position`, or as near to it as its steps are applicable.
    pub(super) fn go_to(&mut self, position: usize) {
        self.back_to(position.min(self.own));
        while self.own < position {
            let Some(step) = self.steps.get(self.own) else { return };
            if !self.take(step) {
                return;
            }
            self.own += 1;
        }
    }

    /// Undoes steps until this many are left.
    pub(super) fn back_to(&mut self, count: usize) {
        while self.taken.len() > count {
            let Some(diff) = self.taken.pop() else { return };
            self.moment += 1;
            for atom in &diff.added {
                self.state.facts[atom.predicate].delete(&atom.arguments, self.moment);
            }
            for atom in &diff.deleted {
                self.state.facts[atom.predicate].add(&atom.arguments, self.moment);
            }
            for change in diff.fluents {
                self.state.set_fluent(change.fluent, change.before);
            }
        }
        self.own = self.own.min(count);
    }

    /// Executes a step, if it is applicable and the budget allows it.
    pub(super) fn take(&mut self, step: &PlanStep) -> bool {
        let Some(left) = self.left.checked_sub(1) else { return false };
        self.left = left;
        let prepared = self.prepared;
        let Some(action) = prepared.domain.actions.get(step.action) else { return false };
        if prepared.fits(&action.variables, &step.arguments).is_err() {
            return false;
        }
        self.moment += 1;
        let moment = self.moment;
        prepared.derive_for(&action.precondition, &mut self.state, moment);
        each_guard(&action.effect, &mut |guard, _| prepared.derive_for(guard, &mut self.state, moment));
        self.binding.reset(&action.variables, &step.arguments);
        let now = u32::try_from(self.taken.len()).unwrap_or(u32::MAX);
        let scene = prepared.scene(&self.state, &action.variables, Clock::steps(now));
        if !scene.holds(&action.precondition, &mut self.binding) {
            return false;
        }
        self.changes.clear();
        let mut diff = Diff::default();
        let done = self
            .changes
            .collect(scene, &action.effect, &mut self.binding)
            .and_then(|()| self.changes.apply(&mut self.state, moment, Some(&mut diff)));
        if done.is_ok() {
            self.taken.push(diff);
        }
        done.is_ok()
    }

    /// Whether the goal holds here.
    pub(super) fn at_goal(&mut self) -> bool {
        let problem = self.prepared.problem;
        self.moment += 1;
        self.prepared.derive_for(&problem.goal, &mut self.state, self.moment);
        let variables = &problem.goal_variables;
        let now = u32::try_from(self.taken.len()).unwrap_or(u32::MAX);
        let scene = self.prepared.scene(&self.state, variables, Clock::steps(now));
        scene.holds(&problem.goal, &mut Binding::new(variables, &[]))
    }

    /// Whether all steps of the changed plan are applicable and the goal holds at its end.
    pub(super) fn passes(&mut self, edit: &Edit) -> bool {
        self.fails(edit).is_none()
    }

    /// Where the changed plan fails: at an inapplicable step, or after the last step.
    pub(super) fn fails(&mut self, edit: &Edit) -> Option<usize> {
        let first = edit.first();
        self.go_to(first);
        if self.own < first {
            return Some(self.own);
        }
        for position in first.. {
            let Some(step) = edit.step(self.steps, position) else { break };
            if !self.take(step) {
                return Some(position);
            }
        }
        if self.at_goal() { None } else { Some(self.taken.len()) }
    }
}

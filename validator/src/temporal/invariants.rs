//! The running actions and their `over all` conditions.

use super::active::{Active, given, over_all};
use super::flow::Flow;
use super::run::{Checked, Run};
use super::watch::{Reads, Ticket};
use crate::cause::Causes;
use crate::number::Number;
use crate::plan::StepIndex;
use crate::preference::violated;
use crate::root::Instant;
use crate::scene::Clock;
use crate::verdict::Failure;
use pddl::model::TimeSpecifier;

impl<'v> Run<'_, 'v, '_> {
    /// Starts an action.
    pub(super) fn join(&mut self, active: Active<'v>) {
        let reads = self.reads(&active);
        let continuous = !active.action.continuous.is_empty();
        let ticket = self.active.insert(active, reads);
        if let Some((_, reads)) = self.active.with_reads(ticket) {
            self.watch.join(ticket, reads);
        }
        if continuous {
            self.begin_linear(ticket);
        }
    }

    /// Ends the action of a step and returns it.
    pub(super) fn leave(&mut self, step: StepIndex) -> Option<Active<'v>> {
        let (ticket, active, reads) = self.active.remove(step)?;
        self.watch.leave(ticket, &reads);
        self.end_linear(ticket);
        Some(active)
    }

    /// The facts and fluents whose change requires another check of the running action.
    pub(super) fn reads(&self, active: &Active<'v>) -> Reads {
        let action = active.action;
        let mut reads = Reads::default();
        for condition in over_all(action) {
            self.basis.condition(condition, &active.binding, &mut reads);
        }
        for (effect, binding) in &active.armed {
            for condition in given(&action.effects[*effect].given, &TimeSpecifier::OverAll) {
                self.basis.condition(condition, binding, &mut reads);
            }
        }
        for (preference, binding) in &active.kept {
            self.basis.condition(&action.preferences[*preference].body.condition, binding, &mut reads);
        }
        reads.settle();
        reads
    }

    /// Adds the instants inside `0..length` at which a condition of a running action may change.
    pub(super) fn critical_of(
        &self,
        active: &Active<'_>,
        flow: &Flow,
        length: Number,
        into: &mut Vec<Instant>,
    ) {
        let clock = Clock { duration: Some(active.duration), ..Clock::at(self.now) };
        let scene = self.prepared.scene(self.state, &active.action.variables, clock);
        let mut binding = active.binding.clone();
        for condition in over_all(active.action) {
            flow.critical(condition, scene, &mut binding, length, into);
        }
        for (effect, binding) in &active.armed {
            for condition in given(&active.action.effects[*effect].given, &TimeSpecifier::OverAll) {
                flow.critical(condition, scene, &mut binding.clone(), length, into);
            }
        }
        for (preference, binding) in &active.kept {
            let condition = &active.action.preferences[*preference].body.condition;
            flow.critical(condition, scene, &mut binding.clone(), length, into);
        }
    }

    /// Checks every `over all` condition that may have changed.
    pub(super) fn invariants(&mut self, at: Number) -> Checked {
        self.watch.due().into_iter().try_for_each(|ticket| self.invariant(ticket, at))
    }

    /// Checks the `over all` conditions of one running action.
    pub(super) fn invariant(&mut self, ticket: Ticket, at: Number) -> Checked {
        let Some(&Active { step, action, duration, .. }) = self.active.get(ticket) else { return Ok(()) };
        for condition in over_all(action) {
            self.derive_for(condition);
            let clock = Clock { duration: Some(duration), ..Clock::at(at) };
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            let Some(Active { binding, .. }) = self.active.get_mut(ticket) else { continue };
            if !scene.holds(condition, binding) {
                let causes = Causes::Listed(&self.causes);
                let parts = self.prepared.lacks(scene, causes, condition, binding);
                return Err(Box::new(Failure::Invariant { step, time: at, parts }));
            }
        }
        self.disarm(ticket, at);
        self.judge_kept(ticket, at);
        Ok(())
    }

    /// Drops the end effects whose `over all` condition does not hold.
    fn disarm(&mut self, ticket: Ticket, at: Number) {
        let Some(active) = self.active.get_mut(ticket) else { return };
        let (action, duration) = (active.action, active.duration);
        let mut armed = std::mem::take(&mut active.armed);
        let clock = Clock { duration: Some(duration), ..Clock::at(at) };
        armed.retain_mut(|(effect, binding)| {
            given(&action.effects[*effect].given, &TimeSpecifier::OverAll).all(|condition| {
                self.derive_for(condition);
                self.prepared.scene(self.state, &action.variables, clock).holds(condition, binding)
            })
        });
        if let Some(active) = self.active.get_mut(ticket) {
            active.armed = armed;
        }
    }

    /// Counts the `over all` preferences that do not hold now; each is counted once.
    fn judge_kept(&mut self, ticket: Ticket, at: Number) {
        let Some(active) = self.active.get_mut(ticket) else { return };
        let (action, duration) = (active.action, active.duration);
        let mut kept = std::mem::take(&mut active.kept);
        let clock = Clock { duration: Some(duration), ..Clock::at(at) };
        kept.retain_mut(|(preference, binding)| {
            let preference = &action.preferences[*preference];
            let condition = &preference.body.condition;
            self.derive_for(condition);
            let scene = self.prepared.scene(self.state, &action.variables, clock);
            let holds = scene.holds(condition, binding);
            if !holds {
                self.demands.violations.add(violated(preference, &action.variables, binding));
            }
            holds
        });
        if let Some(active) = self.active.get_mut(ticket) {
            active.kept = kept;
        }
    }
}

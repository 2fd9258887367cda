//! The durative actions that run.
//!
//! Problem: with ten thousand at one time, nothing may ask each of them at each happening. Idea: each has a [`Ticket`],
//! the next free number; what is kept of it is found by its ticket or its step, and those that change something
//! continuously are listed apart. Invariant: tickets are given in the order in which actions start, so that a set of
//! them is in that order, which is the order in which what fails is told.

use super::Run;
use super::over_all;
use super::watch::Reads;
use crate::number::Number;
use crate::scene::Binding;
use crate::verdict::StepIndex;
use pddl::model::{DurativeAction, TimeSpecifier};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// The number of a durative action that has started.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct Ticket(u32);

/// A durative action that runs.
#[derive(Clone, Debug)]
pub(super) struct Active<'v> {
    pub(super) step: StepIndex,
    pub(super) action: &'v DurativeAction,
    pub(super) binding: Binding,
    pub(super) duration: Number,
    /// Effects at the end whose conditions at the start held, each with its bindings.
    pub(super) armed: Vec<(usize, Binding)>,
    /// Preferences over the whole time that have held until now, each with its bindings.
    pub(super) kept: Vec<(usize, Binding)>,
}

/// All of them.
#[derive(Debug, Default)]
pub(super) struct Actives<'v> {
    by_ticket: Vec<Option<Box<(Active<'v>, Reads)>>>,
    by_step: FxHashMap<StepIndex, Ticket>,
    /// Those with continuous effects.
    continuous: BTreeSet<Ticket>,
}

impl<'v> Actives<'v> {
    pub(super) fn get(&self, ticket: Ticket) -> Option<&Active<'v>> {
        self.by_ticket.get(ticket.0 as usize)?.as_deref().map(|(active, _)| active)
    }

    pub(super) fn with_reads(&self, ticket: Ticket) -> Option<&(Active<'v>, Reads)> {
        self.by_ticket.get(ticket.0 as usize)?.as_deref()
    }

    pub(super) fn get_mut(&mut self, ticket: Ticket) -> Option<&mut Active<'v>> {
        self.by_ticket.get_mut(ticket.0 as usize)?.as_deref_mut().map(|(active, _)| active)
    }

    /// Those with continuous effects, in the order in which they started.
    pub(super) fn continuous(&self) -> impl Iterator<Item = &Active<'v>> {
        self.continuous.iter().filter_map(|&ticket| self.get(ticket))
    }
}

impl<'v> Run<'_, 'v, '_> {
    /// An action runs from now on.
    pub(super) fn join(&mut self, active: Active<'v>) {
        let number = u32::try_from(self.active.by_ticket.len()).expect("a plan has fewer than 2^32 steps");
        let ticket = Ticket(number);
        let reads = self.reads(&active);
        self.watch.join(ticket, &reads);
        self.active.by_step.insert(active.step, ticket);
        let continuous = !active.action.continuous.is_empty();
        self.active.by_ticket.push(Some(Box::new((active, reads))));
        if continuous {
            self.active.continuous.insert(ticket);
            self.enter_lane(ticket);
        }
    }

    /// The action of a step, which runs no longer.
    pub(super) fn leave(&mut self, step: StepIndex) -> Option<Active<'v>> {
        let ticket = self.active.by_step.remove(&step)?;
        let (active, reads) = *self.active.by_ticket.get_mut(ticket.0 as usize)?.take()?;
        self.active.continuous.remove(&ticket);
        self.watch.leave(ticket, &reads);
        self.leave_lane(ticket);
        Some(active)
    }

    /// What must be looked at again when it changes, as long as the action runs.
    fn reads(&self, active: &Active<'v>) -> Reads {
        let action = active.action;
        let mut reads = Reads::default();
        for condition in over_all(action) {
            self.basis.condition(condition, &active.binding, &mut reads);
        }
        for (effect, binding) in &active.armed {
            for condition in super::given(&action.effects[*effect].given, &TimeSpecifier::OverAll) {
                self.basis.condition(condition, binding, &mut reads);
            }
        }
        for (preference, binding) in &active.kept {
            self.basis.condition(&action.preferences[*preference].body.condition, binding, &mut reads);
        }
        reads.settle();
        reads
    }
}

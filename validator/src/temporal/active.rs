//! The durative actions that are running.
//!
//! Problem: with ten thousand at once, a happening must not visit all of them. Idea: each has a [`Ticket`], the next
//! free number. Its data is found by ticket or by step, and actions with continuous effects are listed separately.
//! Invariant: tickets increase in the order in which actions start, so a sorted set of tickets has that order, and so
//! have the failures that are reported.

use super::watch::{Reads, Ticket};
use crate::number::Number;
use crate::plan::StepIndex;
use crate::scene::Binding;
use pddl::model::{Condition, DurativeAction, Given, TimeSpecifier};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// A durative action that runs.
#[derive(Clone, Debug)]
pub(super) struct Active<'v> {
    pub(super) step: StepIndex,
    pub(super) action: &'v DurativeAction,
    pub(super) binding: Binding,
    pub(super) duration: Number,
    /// End effects whose start conditions held, each with its binding.
    pub(super) armed: Vec<(usize, Binding)>,
    /// `over all` preferences that have held so far, each with its binding.
    pub(super) kept: Vec<(usize, Binding)>,
}

/// All running actions.
#[derive(Debug, Default)]
pub(super) struct Actives<'v> {
    by_ticket: Vec<Option<Box<(Active<'v>, Reads)>>>,
    by_step: FxHashMap<StepIndex, Ticket>,
    /// The actions with continuous effects.
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

    /// Adds an action that starts.
    pub(super) fn insert(&mut self, active: Active<'v>, reads: Reads) -> Ticket {
        let number = u32::try_from(self.by_ticket.len()).expect("a plan has fewer than 2^32 steps");
        let ticket = Ticket(number);
        self.by_step.insert(active.step, ticket);
        if !active.action.continuous.is_empty() {
            self.continuous.insert(ticket);
        }
        self.by_ticket.push(Some(Box::new((active, reads))));
        ticket
    }

    /// Removes the action of a step.
    pub(super) fn remove(&mut self, step: StepIndex) -> Option<(Ticket, Active<'v>, Reads)> {
        let ticket = self.by_step.remove(&step)?;
        let (active, reads) = *self.by_ticket.get_mut(ticket.0 as usize)?.take()?;
        self.continuous.remove(&ticket);
        Some((ticket, active, reads))
    }

    /// The actions with continuous effects, in the order of their starts.
    pub(super) fn continuous(&self) -> impl Iterator<Item = &Active<'v>> {
        self.continuous.iter().filter_map(|&ticket| self.get(ticket))
    }
}

/// The conditions at one time around an effect at another time.
pub(super) fn given<'v>(given: &'v [Given], when: &TimeSpecifier) -> impl Iterator<Item = &'v Condition> {
    let timed = given.iter().flat_map(|given| match given {
        Given::When(conditions) => conditions.as_slice(),
        Given::Forall(_) => &[],
    });
    timed.filter(move |timed| timed.when == *when).map(|timed| &timed.condition)
}

/// The conditions that must hold from just after the start until just before the end.
pub(super) fn over_all(action: &DurativeAction) -> impl Iterator<Item = &Condition> {
    action
        .conditions
        .iter()
        .filter(|timed| timed.when == TimeSpecifier::OverAll)
        .map(|timed| &timed.condition)
}

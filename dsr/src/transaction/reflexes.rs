//! The registered reflexes, and how they fire in the commit that breaks them.
//!
//! Invariants: a reflex fires at most once and registers no other, so at most as many fire as are registered. A reflex
//! never makes another agent's commit fail: its edits are tried when it is registered; edits that have become
//! impossible when it fires are left out, and the delta reports that it fired all the same. Cost: for each commit, one
//! intersection of small bit sets per reflex; only the reflexes that the commit touches are matched.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::apply::apply;
use super::edit::Edit;
use super::error::TransactionError;
use super::names::resource_name;
use super::{claim, invariants};
use crate::id::{AgentId, AttributeId, LabelId, ReflexId, ResourceId, Version};
use crate::lease::lease;
use crate::mentions::Mentions;
use crate::reflex::Reflex;
use crate::state::State;

/// A registered reflex.
#[derive(Debug)]
struct Registered {
    reflex: Reflex,
    /// Its leases, each with the version in which it was granted.
    leases: Vec<(ResourceId, Version)>,
    /// The tokens that its conditions depend on.
    mentions: Mentions,
}

/// The registered reflexes, by id. A copy costs a reference count.
#[derive(Debug, Clone, Default)]
pub(crate) struct Registry {
    next: u64,
    live: Arc<BTreeMap<ReflexId, Arc<Registered>>>,
}

/// What outlives the process of a registered reflex: whose it is, and what it writes when its owner expires.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Guard {
    pub(crate) id: ReflexId,
    pub(crate) owner: AgentId,
    pub(crate) on_break: Vec<Edit>,
}

impl Registry {
    /// The registered reflexes as a journal keeps them.
    pub(crate) fn guards(&self) -> impl Iterator<Item = Guard> + '_ {
        self.live.keys().filter_map(|id| self.guard(*id))
    }

    /// A reflex as a journal keeps it, if it is registered.
    pub(crate) fn guard(&self, id: ReflexId) -> Option<Guard> {
        let Reflex { owner, on_break, .. } = &self.live.get(&id)?.reflex;
        Some(Guard { id, owner: *owner, on_break: on_break.clone() })
    }

    /// Reflexes from a journal. Their conditions ended with their process: each fires when its owner expires, and its
    /// leases return then like all others.
    pub(crate) fn restore(guards: impl IntoIterator<Item = Guard>) -> Self {
        let mut registry = Self::default();
        let live = Arc::make_mut(&mut registry.live);
        // What no registration would have accepted is no reflex.
        let claims =
            |edit: &Edit| matches!(edit, Edit::Claim { .. } | Edit::Await { .. } | Edit::Expire { .. });
        let accepted = guards.into_iter().filter(|guard| !guard.on_break.iter().any(claims));
        for Guard { id, owner, on_break } in accepted {
            registry.next = registry.next.max(id.0.saturating_add(1));
            let reflex = Reflex { owner, keep: Vec::new(), on_break, leases: Vec::new() };
            let registered = Registered { reflex, leases: Vec::new(), mentions: Mentions::default() };
            live.insert(id, Arc::new(registered));
        }
        registry
    }

    /// The agent whose reflex it is, if it is registered.
    pub(crate) fn owner(&self, id: ReflexId) -> Option<AgentId> {
        self.live.get(&id).map(|registered| registered.reflex.owner)
    }

    /// Registers a reflex, if its conditions hold now and its edits would be accepted now.
    pub(super) fn register(
        &mut self,
        state: &mut State,
        writer: AgentId,
        reflex: &Reflex,
        version: Version,
    ) -> Result<ReflexId, TransactionError> {
        let owner = state.agent_name(reflex.owner);
        if reflex.owner != writer {
            return Err(TransactionError::NotOwner { writer: state.agent_name(writer), owner });
        }
        let claims = reflex.on_break.iter().find_map(|edit| match edit {
            Edit::Claim { resource, .. } | Edit::Await { resource, .. } => Some(*resource),
            _ => None,
        });
        if let Some(resource) = claims {
            return Err(TransactionError::ReflexClaims { owner, resource: resource_name(state, resource) });
        }
        if let Some(keep) = reflex.keep.iter().position(|keep| !keep.holds(state)) {
            return Err(TransactionError::KeepBroken { owner, keep });
        }
        let mut leases = Vec::with_capacity(reflex.leases.len());
        for &resource in &reflex.leases {
            let vocabulary = &state.vocabulary;
            let name = vocabulary
                .resource_name(resource)
                .ok_or(TransactionError::UnknownResource { id: resource })?;
            match lease(state, resource) {
                Some(lease) if lease.holder == writer => leases.push((resource, lease.claimed)),
                _ => return Err(TransactionError::NotHeld { owner, resource: name.clone() }),
            }
        }
        let mark = state.mark();
        write(state, reflex, version)
            .map_err(|error| TransactionError::ReflexRefused { owner, error: Box::new(error) })?;
        state.roll_back(mark);

        let mut mentions = Mentions::default();
        for bound in reflex.keep.iter().flat_map(|keep| &keep.any) {
            mentions.extend(bound.pattern.mentions());
        }
        if !leases.is_empty() {
            mentions.add_label(LabelId::HOLDS);
            mentions.add_attribute(AttributeId::CLAIM);
        }
        let id = ReflexId(self.next);
        self.next += 1;
        let registered = Registered { reflex: reflex.clone(), leases, mentions };
        Arc::make_mut(&mut self.live).insert(id, Arc::new(registered));
        Ok(id)
    }

    /// Ends a reflex and releases its leases.
    pub(super) fn dismiss(
        &mut self,
        state: &mut State,
        writer: AgentId,
        id: ReflexId,
        version: Version,
    ) -> Result<(), TransactionError> {
        let registered = self.live.get(&id).cloned().ok_or(TransactionError::ReflexGone { reflex: id })?;
        if registered.reflex.owner != writer {
            let owner = state.agent_name(registered.reflex.owner);
            return Err(TransactionError::NotOwner { writer: state.agent_name(writer), owner });
        }
        Arc::make_mut(&mut self.live).remove(&id);
        registered.release(state, version);
        Ok(())
    }

    /// Fires broken reflexes, the lowest id first, until none is broken.
    pub(super) fn fire_broken(&mut self, state: &mut State, version: Version) -> Vec<ReflexId> {
        let mut fired = Vec::new();
        while let Some((id, registered)) = self.first_broken(state) {
            Arc::make_mut(&mut self.live).remove(&id);
            fired.push(id);
            registered.release(state, version);
            // Edits that are no longer possible are left out; the reflex has fired all the same.
            let _ = write(state, &registered.reflex, version);
            claim::settle(state, version);
        }
        fired
    }

    fn first_broken(&self, state: &State) -> Option<(ReflexId, Arc<Registered>)> {
        let found = self.live.iter().find(|(_, registered)| registered.is_broken(state));
        found.map(|(id, registered)| (*id, Arc::clone(registered)))
    }
}

impl Registered {
    fn is_broken(&self, state: &State) -> bool {
        if state.log.expired.contains(&self.reflex.owner) {
            return true;
        }
        let holds = || {
            self.leases.iter().all(|lease| self.still_holds(state, *lease))
                && self.reflex.keep.iter().all(|keep| keep.holds(state))
        };
        self.mentions.intersects(&state.log.mentions) && !holds()
    }

    fn still_holds(&self, state: &State, (resource, claimed): (ResourceId, Version)) -> bool {
        lease(state, resource)
            .is_some_and(|lease| lease.holder == self.reflex.owner && lease.claimed == claimed)
    }

    fn release(&self, state: &mut State, version: Version) {
        for &lease in &self.leases {
            if self.still_holds(state, lease) {
                claim::give_up(state, self.reflex.owner, lease.0, version);
            }
        }
    }
}

/// Writes the edits of a reflex as its owner: all of them, or none. An edit whose node no longer exists is left out.
fn write(state: &mut State, reflex: &Reflex, version: Version) -> Result<(), TransactionError> {
    let mark = state.mark();
    let written =
        reflex.on_break.iter().try_for_each(|edit| match apply(state, reflex.owner, edit, version) {
            Err(TransactionError::UnknownNode { .. }) => Ok(()),
            other => other,
        });
    let checked = written.and_then(|()| invariants::check(state, mark));
    if checked.is_err() {
        state.roll_back(mark);
    }
    checked
}

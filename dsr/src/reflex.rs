//! Reflexes: what must happen in the very commit that breaks a running activity's condition.
//!
//! Problem: a robot that goes on speaking to an empty chair until its planner notices. Idea: an activity leaves
//! with the graph what must keep holding and what to write when it no longer does. Every commit, before it is
//! published, lets the broken reflexes write as their owners, so nobody ever sees the person gone and the robot
//! still speaking.
//!
//! Invariants: a reflex fires at most once and cannot register others, so the fixpoint takes at most as many
//! firings as there are reflexes. A reflex never makes somebody else's commit fail: it is tried once when it is
//! registered; what it can no longer write when it fires is left out, and the attempt is in the delta all the same.
//! Cost: per commit, one intersection of small bit sets per reflex; matching only for those that the commit
//! touches.
//!
//! Source: the agents' "grammar" of Marfil et al., §3.2 and §4.3, whose authors left this to each agent's care.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AgentId, LabelId, NodeId, ReflexId, ResourceId, Version};
use crate::mentions::Mentions;
use crate::pattern::{Pattern, PatternError, PatternSource, Variable};
use crate::state::State;
use crate::transaction::apply::{apply, judge, resource_name};
use crate::transaction::{Edit, TransactionError};
use crate::vocabulary::Vocabulary;

/// A pattern with some of its variables fixed. With `P` = [`PatternSource`] it is plain data, as all of a [`Reflex`] is.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Bound<P = Arc<Pattern>> {
    /// The pattern.
    pub pattern: P,
    /// The fixed variables.
    pub binding: Vec<(Variable, NodeId)>,
}

/// A condition to keep: at least one of the alternatives must have a match.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Keep<P = Arc<Pattern>> {
    /// The alternatives.
    pub any: Vec<Bound<P>>,
}

impl From<Bound> for Keep {
    fn from(bound: Bound) -> Self {
        Self { any: vec![bound] }
    }
}

impl Keep {
    fn holds(&self, state: &State) -> bool {
        self.any.iter().any(|bound| bound.pattern.holds_in(state, &bound.binding))
    }
}

/// What an activity leaves with the graph.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Reflex<P = Arc<Pattern>> {
    /// Whose activity it is; the writer of the transaction that registers it.
    pub owner: AgentId,
    /// What must keep holding, all of it.
    pub keep: Vec<Keep<P>>,
    /// What to write when it no longer does. An edit that names a node that is gone is left out; if another
    /// cannot be made, none is. It takes no lease and waits for none.
    pub on_break: Vec<Edit>,
    /// Leases that the activity needs. Losing one breaks the reflex; firing or dismissing gives them back.
    pub leases: Vec<ResourceId>,
}

impl Reflex<PatternSource> {
    /// The reflex of a vocabulary.
    pub fn build(self, vocabulary: &Vocabulary) -> Result<Reflex, PatternError> {
        let bound = |Bound { pattern, binding }: Bound<PatternSource>| {
            let pattern = Arc::new(pattern.build(vocabulary)?);
            match binding.iter().find(|(variable, _)| !pattern.gives(*variable)) {
                Some((variable, _)) => Err(PatternError::OutOfScope { variable: *variable }),
                None => Ok(Bound { pattern, binding }),
            }
        };
        let keep = |keep: Keep<PatternSource>| {
            Ok(Keep { any: keep.any.into_iter().map(bound).collect::<Result<_, PatternError>>()? })
        };
        let Self { owner, keep: kept, on_break, leases } = self;
        Ok(Reflex {
            owner,
            keep: kept.into_iter().map(keep).collect::<Result<_, PatternError>>()?,
            on_break,
            leases,
        })
    }
}

/// A reflex that is registered, with the grant of each of its leases.
#[derive(Debug, Clone)]
struct Registered {
    reflex: Reflex,
    leases: Vec<(ResourceId, Version)>,
    mentions: Mentions,
}

/// The reflexes of a state, by id.
#[derive(Debug, Clone, Default)]
pub(crate) struct Registry {
    next: u64,
    live: Arc<BTreeMap<ReflexId, Arc<Registered>>>,
    /// Owners declared dead by the transaction in progress.
    condemned: Vec<AgentId>,
}

impl Registry {
    pub(crate) fn condemn(&mut self, owner: AgentId) {
        self.condemned.push(owner);
    }

    /// How many owners are declared dead.
    pub(crate) fn condemned(&self) -> usize {
        self.condemned.len()
    }

    /// Takes back what was declared after the first `kept`.
    pub(crate) fn forget_condemned(&mut self, kept: usize) {
        self.condemned.truncate(kept);
    }
}

impl State {
    /// Registers a reflex, if what it is to keep holds now and what it would do could be done now.
    pub(crate) fn register(
        &mut self,
        writer: AgentId,
        reflex: &Reflex,
        version: Version,
    ) -> Result<ReflexId, TransactionError> {
        let owner = || self.agent_name(reflex.owner);
        if reflex.owner != writer {
            return Err(TransactionError::NotOwner { writer: self.agent_name(writer), owner: owner() });
        }
        let claims = reflex.on_break.iter().find_map(|edit| match edit {
            Edit::Claim { resource, .. } | Edit::Await { resource, .. } => Some(*resource),
            _ => None,
        });
        if let Some(resource) = claims {
            let resource = resource_name(self, resource);
            return Err(TransactionError::ReflexClaims { owner: owner(), resource });
        }
        if let Some(keep) = reflex.keep.iter().position(|keep| !keep.holds(self)) {
            return Err(TransactionError::KeepBroken { owner: owner(), keep });
        }
        let mut leases = Vec::with_capacity(reflex.leases.len());
        for &resource in &reflex.leases {
            let name = self
                .vocabulary
                .resource_name(resource)
                .ok_or(TransactionError::UnknownResource { id: resource })?;
            match self.lease(resource) {
                Some(lease) if lease.holder == writer => leases.push((resource, lease.claimed)),
                _ => return Err(TransactionError::NotHeld { owner: owner(), resource: name.clone() }),
            }
        }
        let name = owner();
        let mark = self.mark();
        self.react(reflex, version)
            .map_err(|error| TransactionError::ReflexRefused { owner: name, error: Box::new(error) })?;
        self.roll_back(mark);

        let mut mentions = Mentions::default();
        for bound in reflex.keep.iter().flat_map(|keep| &keep.any) {
            mentions.extend(bound.pattern.mentions());
        }
        if !leases.is_empty() {
            mentions.add_label(LabelId::HOLDS);
            mentions.add_attribute(crate::id::AttributeId::CLAIM);
        }
        let id = ReflexId(self.reflexes.next);
        self.reflexes.next += 1;
        let registered = Registered { reflex: reflex.clone(), leases, mentions };
        Arc::make_mut(&mut self.reflexes.live).insert(id, Arc::new(registered));
        Ok(id)
    }

    /// Ends a reflex and gives back its leases.
    pub(crate) fn dismiss(
        &mut self,
        writer: AgentId,
        id: ReflexId,
        version: Version,
    ) -> Result<(), TransactionError> {
        let registered =
            self.reflexes.live.get(&id).cloned().ok_or(TransactionError::ReflexGone { reflex: id })?;
        if registered.reflex.owner != writer {
            let owner = self.agent_name(registered.reflex.owner);
            return Err(TransactionError::NotOwner { writer: self.agent_name(writer), owner });
        }
        Arc::make_mut(&mut self.reflexes.live).remove(&id);
        self.give_back(&registered, version);
        Ok(())
    }

    /// Fires broken reflexes, lowest id first, until none is broken.
    pub(crate) fn fire_broken(&mut self, version: Version) -> Vec<ReflexId> {
        let mut fired = Vec::new();
        while let Some((id, registered)) = self.first_broken() {
            Arc::make_mut(&mut self.reflexes.live).remove(&id);
            fired.push(id);
            self.give_back(&registered, version);
            // What it can no longer write is left out; that it fired is told all the same.
            let _ = self.react(&registered.reflex, version);
            self.settle_leases(version);
        }
        self.reflexes.condemned.clear();
        fired
    }

    /// Writes what the reflex writes, all of it or nothing. Edits whose node is gone have nothing left to write on.
    fn react(&mut self, reflex: &Reflex, version: Version) -> Result<(), TransactionError> {
        let mark = self.mark();
        let written =
            reflex.on_break.iter().try_for_each(|edit| match apply(self, reflex.owner, edit, version) {
                Err(TransactionError::UnknownNode { .. }) => Ok(()),
                other => other,
            });
        let judged = written.and_then(|()| judge(self, mark));
        if judged.is_err() {
            self.roll_back(mark);
        }
        judged
    }

    fn first_broken(&self) -> Option<(ReflexId, Arc<Registered>)> {
        let broken = |registered: &Registered| {
            self.reflexes.condemned.contains(&registered.reflex.owner)
                || (registered.mentions.intersects(&self.log.mentions)
                    && !(registered
                        .leases
                        .iter()
                        .all(|lease| self.still_held(registered.reflex.owner, *lease))
                        && registered.reflex.keep.iter().all(|keep| keep.holds(self))))
        };
        self.reflexes
            .live
            .iter()
            .find(|(_, registered)| broken(registered))
            .map(|(id, r)| (*id, Arc::clone(r)))
    }

    fn still_held(&self, owner: AgentId, (resource, claimed): (ResourceId, Version)) -> bool {
        self.lease(resource).is_some_and(|lease| lease.holder == owner && lease.claimed == claimed)
    }

    fn give_back(&mut self, registered: &Registered, version: Version) {
        for &lease in &registered.leases {
            if self.still_held(registered.reflex.owner, lease) {
                self.give_up(registered.reflex.owner, lease.0, version);
            }
        }
    }
}

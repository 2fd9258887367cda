//! Leases of exclusive resources, as the graph shows them: who speaks, who has the screen, who drives, and who is next.
//!
//! Problem: the paper's agents "are responsible for not unnecessarily disturbing a course of action". Idea: a lease is
//! an edge `holds` from an agent to a resource, and a wait is an edge `awaits`. Both carry their priority as
//! attributes, so every agent sees them and patterns can mention them. This file reads them; `transaction::claim`
//! writes them.
//!
//! Invariants:
//! - A resource has at most one holder. An agent awaits at most one resource, and not one that it holds.
//! - The next holder is the waiting agent of the highest priority; among equals, the one that asked first.
//! - Priority is inherited: a lease is worth at least as much as the most urgent wait for its holder, through any
//!   number of waits. So an urgent agent never waits for an agent of low priority that one of medium priority holds up.
//! - Waits have no cycle (see `transaction::claim`).
//!
//! Cost: reading a lease walks the waits for its holder.
//!
//! Source: Sha, Rajkumar, Lehoczky, "Priority inheritance protocols", 1990.

use std::cmp::Reverse;

use serde::{Deserialize, Serialize};

use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, ResourceId, Version};
use crate::state::State;
use crate::value::Value;

/// How urgent a lease is. A larger number is more urgent.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Priority(pub i32);

/// What happens to a lease when another agent claims the resource with a higher priority.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preemption {
    /// The holder stops now: the claimant has the lease from its own commit on.
    #[default]
    Yields,
    /// The holder finishes first: the claim is rejected, whatever its priority. An agent that waits gets the lease when
    /// it is released.
    Finishes,
}

/// A lease, as the graph shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lease {
    /// The agent that holds the resource.
    pub holder: AgentId,
    /// The priority with which the holder claimed it.
    pub priority: Priority,
    /// Whether a claim of higher priority takes it.
    pub preemption: Preemption,
    /// The version in which it was granted.
    pub claimed: Version,
    /// What the lease is worth: its own priority, or that of the most urgent agent that waits for its holder.
    pub inherited: Priority,
}

/// A wait for a lease, as the graph shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Waiting {
    /// The agent that waits.
    pub agent: AgentId,
    /// The priority that the lease will have.
    pub priority: Priority,
    /// The preemption that the lease will have.
    pub preemption: Preemption,
    /// The version in which the agent asked for it.
    pub asked: Version,
    /// What the wait is worth: its own priority, or that of the most urgent agent that waits for this one.
    pub inherited: Priority,
}

/// The attributes of the edge of a lease or a wait: priority, whether it yields, version.
pub(crate) type Terms = [AttributeId; 3];

pub(crate) const HELD: Terms = [AttributeId::PRIORITY, AttributeId::YIELDS, AttributeId::CLAIM];
pub(crate) const AWAITED: Terms =
    [AttributeId::AWAITS_PRIORITY, AttributeId::AWAITS_YIELDS, AttributeId::ASKED];

/// The lease of a resource, if an agent holds it.
pub(crate) fn lease(state: &State, resource: ResourceId) -> Option<Lease> {
    let node = state.vocabulary.resource_node(resource)?;
    let &(label, from) = state.node(node)?.sources(LabelId::HOLDS).first()?;
    let (priority, preemption, claimed) = terms(state, EdgeKey { from, label, to: node }, HELD);
    let holder = state.vocabulary.agent_of(from)?;
    let inherited = priority.max(pressure(state, holder, None, 0).unwrap_or(priority));
    Some(Lease { holder, priority, preemption, claimed, inherited })
}

/// The agents that wait for a resource, the next holder first.
pub(crate) fn waiting(state: &State, resource: ResourceId) -> Vec<Waiting> {
    let mut waiting = waits(state, resource, 0);
    waiting.sort_by_key(|w| (Reverse(w.inherited), w.asked, w.agent));
    waiting
}

fn waits(state: &State, resource: ResourceId, depth: usize) -> Vec<Waiting> {
    let node = state.vocabulary.resource_node(resource);
    let Some((to, node)) = node.and_then(|id| Some((id, state.node(id)?))) else { return Vec::new() };
    let waiting = node.sources(LabelId::AWAITS).iter().filter_map(|&(label, from)| {
        let (priority, preemption, asked) = terms(state, EdgeKey { from, label, to }, AWAITED);
        let agent = state.vocabulary.agent_of(from)?;
        let inherited = priority.max(pressure(state, agent, None, depth).unwrap_or(priority));
        Some(Waiting { agent, priority, preemption, asked, inherited })
    });
    waiting.collect()
}

/// The highest priority of the agents that wait for what `agent` holds, except for the resource `but`.
pub(crate) fn pressure(
    state: &State,
    agent: AgentId,
    but: Option<ResourceId>,
    depth: usize,
) -> Option<Priority> {
    // Waits have no cycle, so no chain of them is longer than the number of agents. An export may contain a cycle.
    if depth > state.vocabulary.agents().count() {
        return None;
    }
    let held = leases_of(state, agent).into_iter().filter(|&resource| Some(resource) != but);
    held.flat_map(|resource| waits(state, resource, depth + 1)).map(|w| w.inherited).max()
}

/// Whether the leases and waits of a state keep the invariants above. Edits always do; a file need not.
pub(crate) fn are_sound(state: &State) -> bool {
    let held_once = state.vocabulary.resources().all(|resource| {
        let node = state.vocabulary.resource_node(resource).and_then(|id| state.node(id));
        node.is_none_or(|node| node.sources(LabelId::HOLDS).len() <= 1)
    });
    let waits = |agent| {
        let node = state.vocabulary.agent_node(agent).and_then(|id| state.node(id));
        node.map_or(0, |node| node.edges(LabelId::AWAITS).len())
    };
    let is_blocked_by_another = |agent| {
        let Some(awaited) = awaited(state, agent) else { return waits(agent) == 0 };
        waits(agent) == 1 && holder(state, awaited).is_some() && cycle(state, agent, awaited).is_none()
    };
    held_once && state.vocabulary.agents().all(is_blocked_by_another)
}

/// The cycle that a wait of `agent` for `resource` closes, if it closes one: each resource with its holder.
///
/// An agent awaits one resource, and a resource has one holder, so the waits that start at a resource are one path.
///
/// Source: Holt, "Some deadlock properties of computer systems", 1972.
pub(crate) fn cycle(
    state: &State,
    agent: AgentId,
    resource: ResourceId,
) -> Option<Vec<(ResourceId, AgentId)>> {
    let (mut path, mut at) = (Vec::new(), resource);
    // A path with more steps than agents has met an agent twice, and not this one.
    for _ in state.vocabulary.agents() {
        let holder = holder(state, at)?;
        path.push((at, holder));
        if holder == agent {
            return Some(path);
        }
        at = awaited(state, holder)?;
    }
    None
}

fn holder(state: &State, resource: ResourceId) -> Option<AgentId> {
    let node = state.node(state.vocabulary.resource_node(resource)?)?;
    let &(_, from) = node.sources(LabelId::HOLDS).first()?;
    state.vocabulary.agent_of(from)
}

/// The resource that an agent awaits.
pub(crate) fn awaited(state: &State, agent: AgentId) -> Option<ResourceId> {
    let node = state.node(state.vocabulary.agent_node(agent)?)?;
    state.vocabulary.resource_of(node.edges(LabelId::AWAITS).first()?.to)
}

/// The resources that an agent holds, ascending.
pub(crate) fn leases_of(state: &State, agent: AgentId) -> Vec<ResourceId> {
    let Some(node) = state.vocabulary.agent_node(agent).and_then(|id| state.node(id)) else {
        return Vec::new();
    };
    node.edges(LabelId::HOLDS).iter().filter_map(|edge| state.vocabulary.resource_of(edge.to)).collect()
}

fn terms(
    state: &State,
    edge: EdgeKey,
    [priority, yields, version]: Terms,
) -> (Priority, Preemption, Version) {
    let value = |attribute| state.cell(Holder::Edge(edge), attribute).map(|cell| &cell.value);
    let number = |attribute| value(attribute).and_then(Value::as_number).unwrap_or(0.0);
    let yields = value(yields).and_then(Value::as_bool).unwrap_or(true);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "`transaction::claim` wrote both numbers, from an i32 and a u64 below 2^53"
    )]
    let (priority, version) = (number(priority) as i32, number(version) as u64);
    let preemption = if yields { Preemption::Yields } else { Preemption::Finishes };
    (Priority(priority), preemption, Version(version))
}

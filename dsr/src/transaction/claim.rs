//! Writing leases: claims, waits and releases.
//!
//! A released lease goes to the next waiting agent in the same commit, so no version shows a free resource that an
//! agent waits for. A lease that *yields* goes to a claimant of strictly higher priority than the lease is worth; one
//! that *finishes* goes to no agent before its holder releases it.
//!
//! Invariant: waits have no cycle. The wait that would close one is rejected. A grant closes none, because an agent
//! that is granted what it awaits awaits nothing any more; other grants are checked. The attribute `claim` is the
//! version of the grant, so a reflex can tell its lease from a later one of the same agent. Cost: a claim walks the
//! waits that it touches.
//!
//! See [`crate::lease`] for the other invariants and for how leases are read.

use super::error::TransactionError;
use super::names::resource_name;
use crate::id::{AgentId, EdgeKey, Holder, LabelId, ResourceId, Version};
use crate::lease::{
    self, AWAITED, HELD, Lease, Preemption, Priority, Terms, awaited, lease, pressure, waiting,
};
use crate::state::State;
use crate::value::Value;

/// Takes a lease for an agent, or reports which agent holds it.
pub(super) fn claim(
    state: &mut State,
    agent: AgentId,
    resource: ResourceId,
    (priority, preemption): (Priority, Preemption),
    since: Version,
) -> Result<(), TransactionError> {
    known(state, resource)?;
    if let Some(lease) = lease(state, resource) {
        if !passes_to(state, &lease, resource, (agent, priority), since) {
            return Err(TransactionError::ResourceHeld {
                resource: resource_name(state, resource),
                holder: state.agent_name(lease.holder),
                priority: lease.priority,
                preemption: lease.preemption,
            });
        }
        erase(state, lease.holder, LabelId::HOLDS, resource);
    }
    grant(state, agent, resource, (priority, preemption), since);
    match awaited(state, agent) {
        Some(awaited) => reject_cycle(state, agent, awaited),
        None => Ok(()),
    }
}

/// Takes a lease for an agent, or makes the agent wait for it.
pub(super) fn claim_or_wait(
    state: &mut State,
    agent: AgentId,
    resource: ResourceId,
    (priority, preemption): (Priority, Preemption),
    since: Version,
) -> Result<(), TransactionError> {
    known(state, resource)?;
    if let Some(awaited) = awaited(state, agent) {
        let resource = resource_name(state, awaited);
        return Err(TransactionError::WaitsAlready { writer: state.agent_name(agent), resource });
    }
    let at_once =
        |lease: Lease| lease.holder == agent || passes_to(state, &lease, resource, (agent, priority), since);
    if lease(state, resource).is_none_or(at_once) {
        return claim(state, agent, resource, (priority, preemption), since);
    }
    reject_cycle(state, agent, resource)?;
    if let Some(edge) = agent_edge(state, agent, LabelId::AWAITS, resource) {
        draw(state, edge, AWAITED, (priority, preemption), since);
    }
    Ok(())
}

/// Releases a lease or ends a wait, if the agent has one for a known resource.
pub(super) fn release(
    state: &mut State,
    agent: AgentId,
    resource: ResourceId,
    since: Version,
) -> Result<(), TransactionError> {
    known(state, resource)?;
    give_up(state, agent, resource, since);
    Ok(())
}

/// Releases a lease or ends a wait, if the agent has one. The next waiting agent has the lease at once.
pub(super) fn give_up(state: &mut State, agent: AgentId, resource: ResourceId, since: Version) {
    erase(state, agent, LabelId::AWAITS, resource);
    if lease(state, resource).is_some_and(|lease| lease.holder == agent) {
        erase(state, agent, LabelId::HOLDS, resource);
        pass_on(state, resource, since);
    }
}

/// Releases every lease of an agent and ends its wait.
pub(super) fn give_up_all(state: &mut State, agent: AgentId, since: Version) {
    // The wait ends first: otherwise a released resource might go to this very agent.
    let all = awaited(state, agent).into_iter().chain(lease::leases_of(state, agent));
    for resource in all.collect::<Vec<_>>() {
        give_up(state, agent, resource, since);
    }
}

/// Passes leases to waiting agents that have become more urgent than the lease is worth.
pub(super) fn settle(state: &mut State, since: Version) {
    if !state.log.mentions.leases() {
        return;
    }
    // Each round ends one wait, so the loop ends.
    while let Some((holder, resource)) = overdue(state) {
        erase(state, holder, LabelId::HOLDS, resource);
        pass_on(state, resource, since);
    }
}

fn overdue(state: &State) -> Option<(AgentId, ResourceId)> {
    state.vocabulary.resources().find_map(|resource| {
        let next = *waiting(state, resource).first()?;
        let lease = lease(state, resource)?;
        gives_way(state, &lease, resource, next.inherited).then_some((lease.holder, resource))
    })
}

/// Whether a lease passes to an agent that claims it with this priority. The claim is worth more if more urgent agents
/// wait for the claimant.
fn passes_to(
    state: &State,
    lease: &Lease,
    resource: ResourceId,
    (agent, priority): (AgentId, Priority),
    since: Version,
) -> bool {
    let worth = match pressure(state, agent, None, 0) {
        Some(pressure) if agent != lease.holder => pressure.max(priority),
        _ => priority,
    };
    // Two claims in one transaction would have the same version of grant, so a reflex could not tell them apart.
    lease.claimed != since && gives_way(state, lease, resource, worth)
}

/// Whether a lease passes to a claim or wait of this worth. Agents that wait for the same resource go on waiting for
/// it, so they do not count; agents that wait for another resource of the holder do.
fn gives_way(state: &State, lease: &Lease, resource: ResourceId, to: Priority) -> bool {
    let pressure = pressure(state, lease.holder, Some(resource), 0);
    lease.preemption == Preemption::Yields && Some(to) > pressure && to > lease.priority
}

fn pass_on(state: &mut State, resource: ResourceId, since: Version) {
    if let Some(next) = waiting(state, resource).first() {
        grant(state, next.agent, resource, (next.priority, next.preemption), since);
    }
}

fn grant(
    state: &mut State,
    agent: AgentId,
    resource: ResourceId,
    terms: (Priority, Preemption),
    since: Version,
) {
    erase(state, agent, LabelId::AWAITS, resource);
    if let Some(edge) = agent_edge(state, agent, LabelId::HOLDS, resource) {
        draw(state, edge, HELD, terms, since);
    }
}

/// Writes the edge of a lease or a wait, with its attributes.
fn draw(
    state: &mut State,
    edge: EdgeKey,
    attributes: Terms,
    (priority, preemption): (Priority, Preemption),
    since: Version,
) {
    state.insert_edge(edge, since);
    #[expect(clippy::cast_precision_loss, reason = "2^53 commits take longer than a robot lives")]
    let version = since.0 as f64;
    let values = [
        Value::Number(f64::from(priority.0)),
        Value::Bool(preemption == Preemption::Yields),
        Value::Number(version),
    ];
    for (attribute, value) in attributes.into_iter().zip(values) {
        state.insert_attribute(Holder::Edge(edge), attribute, value, since);
    }
}

fn erase(state: &mut State, agent: AgentId, label: LabelId, resource: ResourceId) {
    if let Some(edge) = agent_edge(state, agent, label, resource) {
        state.remove_edge(edge);
    }
}

fn agent_edge(state: &State, agent: AgentId, label: LabelId, resource: ResourceId) -> Option<EdgeKey> {
    let from = state.vocabulary.agent_node(agent)?;
    Some(EdgeKey { from, label, to: state.vocabulary.resource_node(resource)? })
}

/// Rejects a wait of `agent` for `resource` that closes a cycle.
fn reject_cycle(state: &State, agent: AgentId, resource: ResourceId) -> Result<(), TransactionError> {
    let Some(cycle) = lease::cycle(state, agent, resource) else { return Ok(()) };
    let named = |(resource, holder)| (resource_name(state, resource), state.agent_name(holder));
    let (writer, circle) = (state.agent_name(agent), cycle.into_iter().map(named).collect());
    Err(TransactionError::Deadlock { writer, circle })
}

fn known(state: &State, id: ResourceId) -> Result<(), TransactionError> {
    state.vocabulary.resource_name(id).map(|_| ()).ok_or(TransactionError::UnknownResource { id })
}

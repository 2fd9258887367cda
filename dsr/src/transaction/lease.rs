//! Leases of exclusive resources: who speaks, who has the screen, who drives, and who is next.
//!
//! Problem: the paper's agents "are responsible for not unnecessarily disturbing a course of action". Idea: a
//! lease is an edge `holds` from an agent to a resource, and a wait for one is an edge `awaits`, each with its priority,
//! so everybody sees them and any pattern can speak of them. A lease that is given back goes to the next who waits in
//! the same commit, so nobody ever sees a free resource that somebody waits for.
//!
//! Invariants: at most one edge `holds` ends at a resource; an agent waits for one resource at most, and not for one
//! that it holds. The next is the one of highest priority, among equals who asked first. A lease that *yields* goes
//! over to whoever is of strictly higher priority than it is worth, one that *finishes* to nobody before it is given
//! back. Priority is inherited: what blocks somebody is worth at least as much as who waits, through any number of
//! waits; so an urgent agent does not wait for a lowly one that a middling one keeps from going on. Agents that wait
//! for each other in a circle are refused when the last of them would close it: each waits for one resource, and a
//! resource has one holder, so the circle is found by walking along it; who is granted a lease by waiting waits for
//! nothing any more, so a grant closes none. The attribute `claim` is the version of the grant, so a reflex knows *its*
//! lease from a later one of the same agent. Cost: a claim walks the waits that it touches.
//!
//! Source: Sha, Rajkumar, Lehoczky, "Priority inheritance protocols", 1990; Holt, "Some deadlock properties of computer
//! systems", 1972.

use std::cmp::Reverse;

use serde::{Deserialize, Serialize};

use super::apply::{known_resource, resource_name};
use super::error::TransactionError;
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, ResourceId, Version};
use crate::state::State;
use crate::value::Value;

/// How much a lease matters; more is more.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Priority(pub i32);

/// What happens to a lease when a claim of higher priority comes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Preemption {
    /// The holder stops now: the lease goes to the claimant in the claimant's commit.
    #[default]
    Yields,
    /// The holder finishes first: a claim is refused, whatever its priority, and who waits gets the lease when it is
    /// given back.
    Finishes,
}

/// A lease, as the graph shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Lease {
    /// Who holds the resource.
    pub holder: AgentId,
    /// How much it matters to the holder.
    pub priority: Priority,
    /// Whether it can be taken.
    pub preemption: Preemption,
    /// The version in which it was granted.
    pub claimed: Version,
    /// How much it matters to anybody: its own priority, or that of the most urgent who waits for its holder.
    pub inherited: Priority,
}

/// A wait for a lease, as the graph shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Waiting {
    /// Who waits.
    pub agent: AgentId,
    /// How much it matters to who waits: the priority of the lease to be.
    pub priority: Priority,
    /// Whether the lease to be can be taken.
    pub preemption: Preemption,
    /// The version in which it was asked for.
    pub asked: Version,
    /// How much it matters to anybody.
    pub inherited: Priority,
}

/// The attributes of a kind of edge: priority, whether it yields, version.
type Terms = [AttributeId; 3];

const HELD: Terms = [AttributeId::PRIORITY, AttributeId::YIELDS, AttributeId::CLAIM];
const AWAITED: Terms = [AttributeId::AWAITS_PRIORITY, AttributeId::AWAITS_YIELDS, AttributeId::ASKED];

impl State {
    pub(crate) fn lease(&self, resource: ResourceId) -> Option<Lease> {
        let node = self.vocabulary.resource_node(resource)?;
        let &(label, from) = self.node(node)?.sources(LabelId::HOLDS).first()?;
        let (priority, preemption, claimed) = self.terms(EdgeKey { from, label, to: node }, HELD);
        let holder = self.vocabulary.agent_of(from)?;
        let inherited = priority.max(self.pressure(holder, None, 0).unwrap_or(priority));
        Some(Lease { holder, priority, preemption, claimed, inherited })
    }

    /// Who waits for a resource, the next first.
    pub(crate) fn waiting(&self, resource: ResourceId) -> Vec<Waiting> {
        let mut waiting = self.waits(resource, 0);
        waiting.sort_by_key(|w| (Reverse(w.inherited), w.asked, w.agent));
        waiting
    }

    fn waits(&self, resource: ResourceId, depth: usize) -> Vec<Waiting> {
        let node = self.vocabulary.resource_node(resource);
        let Some((to, node)) = node.and_then(|id| Some((id, self.node(id)?))) else { return Vec::new() };
        let waiting = node.sources(LabelId::AWAITS).iter().filter_map(|&(label, from)| {
            let (priority, preemption, asked) = self.terms(EdgeKey { from, label, to }, AWAITED);
            let agent = self.vocabulary.agent_of(from)?;
            let inherited = priority.max(self.pressure(agent, None, depth).unwrap_or(priority));
            Some(Waiting { agent, priority, preemption, asked, inherited })
        });
        waiting.collect()
    }

    /// The highest priority of those who wait for what an agent holds, but for one resource.
    fn pressure(&self, agent: AgentId, but: Option<ResourceId>, depth: usize) -> Option<Priority> {
        // Waits have no circle, so no walk along them is longer than there are agents; an export might say otherwise.
        if depth > self.vocabulary.agents().count() {
            return None;
        }
        let held = self.leases_of(agent).into_iter().filter(|&resource| Some(resource) != but);
        held.flat_map(|resource| self.waits(resource, depth + 1)).map(|w| w.inherited).max()
    }

    /// Whether leases and waits are as the edits of this module leave them: read from a file, they need not be.
    pub(crate) fn leases_are_sound(&self) -> bool {
        let held_once = self.vocabulary.resources().all(|resource| {
            let node = self.vocabulary.resource_node(resource).and_then(|id| self.node(id));
            node.is_none_or(|node| node.sources(LabelId::HOLDS).len() <= 1)
        });
        let waits = |agent| {
            let node = self.vocabulary.agent_node(agent).and_then(|id| self.node(id));
            node.map_or(0, |node| node.edges(LabelId::AWAITS).len())
        };
        let is_blocked_by_another = |agent| {
            let Some(awaited) = self.wait_of(agent) else { return waits(agent) == 0 };
            waits(agent) == 1
                && self.holder_of(awaited).is_some()
                && self.refuse_circle(agent, awaited).is_ok()
        };
        held_once && self.vocabulary.agents().all(is_blocked_by_another)
    }

    fn holder_of(&self, resource: ResourceId) -> Option<AgentId> {
        let node = self.node(self.vocabulary.resource_node(resource)?)?;
        let &(_, from) = node.sources(LabelId::HOLDS).first()?;
        self.vocabulary.agent_of(from)
    }

    /// What an agent waits for.
    pub(crate) fn wait_of(&self, agent: AgentId) -> Option<ResourceId> {
        let node = self.node(self.vocabulary.agent_node(agent)?)?;
        self.vocabulary.resource_of(node.edges(LabelId::AWAITS).first()?.to)
    }

    fn terms(&self, edge: EdgeKey, [priority, yields, version]: Terms) -> (Priority, Preemption, Version) {
        let value = |attribute| self.cell(Holder::Edge(edge), attribute).map(|cell| &cell.value);
        let number = |attribute| value(attribute).and_then(Value::as_number).unwrap_or(0.0);
        let yields = value(yields).and_then(Value::as_bool).unwrap_or(true);
        // Both numbers were written by `draw` from an i32 and a u64 below 2^53.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "written by `draw`")]
        let (priority, version) = (number(priority) as i32, number(version) as u64);
        let preemption = if yields { Preemption::Yields } else { Preemption::Finishes };
        (Priority(priority), preemption, Version(version))
    }

    fn draw(
        &mut self,
        edge: EdgeKey,
        terms: Terms,
        priority: Priority,
        preemption: Preemption,
        since: Version,
    ) {
        self.insert_edge(edge, since);
        #[expect(clippy::cast_precision_loss, reason = "2^53 commits take longer than a robot lives")]
        let version = since.0 as f64;
        let values = [
            Value::Number(f64::from(priority.0)),
            Value::Bool(preemption == Preemption::Yields),
            Value::Number(version),
        ];
        for (attribute, value) in terms.into_iter().zip(values) {
            self.insert_attribute(Holder::Edge(edge), attribute, value, since);
        }
    }

    fn agent_edge(&self, agent: AgentId, label: LabelId, resource: ResourceId) -> Option<EdgeKey> {
        let from = self.vocabulary.agent_node(agent)?;
        Some(EdgeKey { from, label, to: self.vocabulary.resource_node(resource)? })
    }

    /// Takes a lease for an agent, or says who has it.
    pub(crate) fn claim(
        &mut self,
        agent: AgentId,
        resource: ResourceId,
        (priority, preemption): (Priority, Preemption),
        since: Version,
    ) -> Result<(), TransactionError> {
        known_resource(self, resource)?;
        if let Some(lease) = self.lease(resource) {
            if !self.goes_over(&lease, resource, (agent, priority), since) {
                return Err(TransactionError::ResourceHeld {
                    resource: resource_name(self, resource),
                    holder: self.agent_name(lease.holder),
                    priority: lease.priority,
                    preemption: lease.preemption,
                });
            }
            self.erase(lease.holder, LabelId::HOLDS, resource);
        }
        self.grant(agent, resource, (priority, preemption), since);
        match self.wait_of(agent) {
            Some(awaited) => self.refuse_circle(agent, awaited),
            None => Ok(()),
        }
    }

    /// Takes a lease for an agent, or makes it wait for its turn.
    pub(crate) fn claim_or_wait(
        &mut self,
        agent: AgentId,
        resource: ResourceId,
        (priority, preemption): (Priority, Preemption),
        since: Version,
    ) -> Result<(), TransactionError> {
        known_resource(self, resource)?;
        if let Some(awaited) = self.wait_of(agent) {
            let resource = resource_name(self, awaited);
            return Err(TransactionError::WaitsAlready { writer: self.agent_name(agent), resource });
        }
        let lease = self.lease(resource);
        let at_once = |lease: Lease| {
            lease.holder == agent || self.goes_over(&lease, resource, (agent, priority), since)
        };
        if lease.is_none_or(at_once) {
            return self.claim(agent, resource, (priority, preemption), since);
        }
        self.refuse_circle(agent, resource)?;
        if let Some(edge) = self.agent_edge(agent, LabelId::AWAITS, resource) {
            self.draw(edge, AWAITED, priority, preemption, since);
        }
        Ok(())
    }

    /// Whether a lease goes over to an agent that claims it with this priority, or is worth more for what it blocks.
    fn goes_over(
        &self,
        lease: &Lease,
        resource: ResourceId,
        (agent, priority): (AgentId, Priority),
        since: Version,
    ) -> bool {
        let worth = match self.pressure(agent, None, 0) {
            Some(pressure) if agent != lease.holder => pressure.max(priority),
            _ => priority,
        };
        // Two claims of one transaction would be one grant: neither could be told from the other.
        lease.claimed != since && self.gives_way(lease, resource, worth)
    }

    /// Whether a lease goes over to somebody of this priority. Those who wait for the same resource go on waiting for
    /// it, so they do not count; those who wait for something else that its holder has, do.
    fn gives_way(&self, lease: &Lease, resource: ResourceId, to: Priority) -> bool {
        let pressure = self.pressure(lease.holder, Some(resource), 0);
        lease.preemption == Preemption::Yields && Some(to) > pressure && to > lease.priority
    }

    /// Gives back a lease, or a place among those who wait; the next who waits has the lease at once.
    pub(crate) fn give_up(&mut self, agent: AgentId, resource: ResourceId, since: Version) {
        self.erase(agent, LabelId::AWAITS, resource);
        if self.lease(resource).is_some_and(|lease| lease.holder == agent) {
            self.erase(agent, LabelId::HOLDS, resource);
            self.pass_on(resource, since);
        }
    }

    /// Gives up all that an agent holds or waits for.
    pub(crate) fn give_up_all(&mut self, agent: AgentId, since: Version) {
        // First the wait, or what is given back might be passed on to the agent itself.
        let all = self.wait_of(agent).into_iter().chain(self.leases_of(agent));
        for resource in all.collect::<Vec<_>>() {
            self.give_up(agent, resource, since);
        }
    }

    fn pass_on(&mut self, resource: ResourceId, since: Version) {
        if let Some(next) = self.waiting(resource).first() {
            self.grant(next.agent, resource, (next.priority, next.preemption), since);
        }
    }

    /// Lets leases go over to those who wait and have become more urgent than what the lease is worth.
    pub(crate) fn settle_leases(&mut self, since: Version) {
        if !self.log.mentions.leases() {
            return;
        }
        // Each time somebody waits no more, so this ends.
        while let Some((holder, resource)) = self.overdue() {
            self.erase(holder, LabelId::HOLDS, resource);
            self.pass_on(resource, since);
        }
    }

    fn overdue(&self) -> Option<(AgentId, ResourceId)> {
        self.vocabulary.resources().find_map(|resource| {
            let next = *self.waiting(resource).first()?;
            let lease = self.lease(resource)?;
            self.gives_way(&lease, resource, next.inherited).then_some((lease.holder, resource))
        })
    }

    fn grant(
        &mut self,
        agent: AgentId,
        resource: ResourceId,
        (priority, preemption): (Priority, Preemption),
        since: Version,
    ) {
        self.erase(agent, LabelId::AWAITS, resource);
        if let Some(edge) = self.agent_edge(agent, LabelId::HOLDS, resource) {
            self.draw(edge, HELD, priority, preemption, since);
        }
    }

    fn erase(&mut self, agent: AgentId, label: LabelId, resource: ResourceId) {
        if let Some(edge) = self.agent_edge(agent, label, resource) {
            self.remove_edge(edge);
        }
    }

    /// Refuses a wait of this agent for this resource if its holder waits, at however many removes, for the agent.
    fn refuse_circle(&self, agent: AgentId, resource: ResourceId) -> Result<(), TransactionError> {
        let (mut circle, mut awaited) = (Vec::new(), resource);
        // As many steps as there are agents: a longer walk has met one twice, and then not this one.
        for _ in self.vocabulary.agents() {
            let Some(holder) = self.holder_of(awaited) else { return Ok(()) };
            circle.push((resource_name(self, awaited), self.agent_name(holder)));
            if holder == agent {
                return Err(TransactionError::Deadlock { writer: self.agent_name(agent), circle });
            }
            match self.wait_of(holder) {
                Some(next) => awaited = next,
                None => return Ok(()),
            }
        }
        Ok(())
    }

    /// The resources that an agent holds, ascending.
    pub(crate) fn leases_of(&self, agent: AgentId) -> Vec<ResourceId> {
        let Some(node) = self.vocabulary.agent_node(agent).and_then(|id: NodeId| self.node(id)) else {
            return Vec::new();
        };
        node.edges(LabelId::HOLDS).iter().filter_map(|edge| self.vocabulary.resource_of(edge.to)).collect()
    }
}

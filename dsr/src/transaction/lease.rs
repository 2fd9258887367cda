//! Leases of exclusive resources: who speaks, who has the screen, who drives.
//!
//! Problem: the paper's agents "are responsible for not unnecessarily disturbing a course of action". Idea: a
//! lease is an edge `holds` from an agent to a resource, with its priority, so everybody sees it and any pattern
//! can speak of it. Invariant: at most one edge `holds` ends at a resource. A claim of strictly higher priority
//! takes the lease from a holder that yields; any other claim on a held resource is refused. The attribute
//! `claim` is the version of the grant, so a reflex knows *its* lease from a later one of the same agent.

use serde::{Deserialize, Serialize};

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
    /// The holder finishes first: the claim is refused, the claimant tries again.
    Finishes,
}

/// A lease, as the graph shows it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Lease {
    /// Who holds the resource.
    pub holder: AgentId,
    /// How much it matters.
    pub priority: Priority,
    /// Whether it can be taken.
    pub preemption: Preemption,
    /// The version in which it was granted.
    pub claimed: Version,
}

impl State {
    pub(crate) fn lease(&self, resource: ResourceId) -> Option<Lease> {
        let node = self.dictionary.resource_node(resource)?;
        let &(label, from) = self.node(node)?.sources(LabelId::HOLDS).first()?;
        let edge = Holder::Edge(EdgeKey { from, label, to: node });
        let value = |attribute| self.cell(edge, attribute).map(|cell| &cell.value);
        let number = |attribute| value(attribute).and_then(Value::as_number).unwrap_or(0.0);
        let yields = value(AttributeId::YIELDS).and_then(Value::as_bool).unwrap_or(true);
        // Both numbers were written by `grant` from an i32 and a u64 below 2^53.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "written by `grant`")]
        let (priority, claimed) = (number(AttributeId::PRIORITY) as i32, number(AttributeId::CLAIM) as u64);
        Some(Lease {
            holder: self.dictionary.agent_of(from)?,
            priority: Priority(priority),
            preemption: if yields { Preemption::Yields } else { Preemption::Finishes },
            claimed: Version(claimed),
        })
    }

    fn lease_edge(&self, agent: AgentId, resource: ResourceId) -> Option<EdgeKey> {
        let from = self.dictionary.agent_node(agent)?;
        Some(EdgeKey { from, label: LabelId::HOLDS, to: self.dictionary.resource_node(resource)? })
    }

    pub(crate) fn grant(
        &mut self,
        agent: AgentId,
        resource: ResourceId,
        priority: Priority,
        preemption: Preemption,
        since: Version,
    ) {
        let Some(key) = self.lease_edge(agent, resource) else { return };
        self.insert_edge(key, since);
        #[expect(clippy::cast_precision_loss, reason = "2^53 commits take longer than a robot lives")]
        let claim = since.0 as f64;
        for (attribute, value) in [
            (AttributeId::PRIORITY, Value::Number(f64::from(priority.0))),
            (AttributeId::YIELDS, Value::Bool(preemption == Preemption::Yields)),
            (AttributeId::CLAIM, Value::Number(claim)),
        ] {
            self.insert_attribute(Holder::Edge(key), attribute, value, since);
        }
    }

    pub(crate) fn revoke(&mut self, agent: AgentId, resource: ResourceId) {
        if let Some(key) = self.lease_edge(agent, resource) {
            self.remove_edge(key);
        }
    }

    /// The resources that an agent holds, ascending.
    pub(crate) fn leases_of(&self, agent: AgentId) -> Vec<ResourceId> {
        let Some(node) = self.dictionary.agent_node(agent).and_then(|id: NodeId| self.node(id)) else {
            return Vec::new();
        };
        node.edges(LabelId::HOLDS).iter().filter_map(|edge| self.dictionary.resource_of(edge.to)).collect()
    }
}

//! Access to the resources that a rule claims.

use dsr::{AgentId, Preemption, ResourceId, Snapshot, Version};

use crate::rules::Rule;

/// Whether a rule could have its resources now.
pub(super) enum Access {
    /// All of them are free.
    Free,
    /// These are held at a lower priority.
    Takeable(Vec<ResourceId>),
    /// One is held at a priority that is not lower, or by a holder that finishes first.
    Refused,
}

pub(super) fn access(snapshot: &Snapshot, rule: &Rule) -> Access {
    let mut takeable = Vec::new();
    for &resource in &rule.claims {
        match snapshot.lease(resource) {
            None => {}
            Some(lease) if lease.priority < rule.priority && lease.preemption == Preemption::Yields => {
                takeable.push(resource);
            }
            Some(_) => return Access::Refused,
        }
    }
    if takeable.is_empty() { Access::Free } else { Access::Takeable(takeable) }
}

/// A resource that was taken for a rule that is about to start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Grant {
    pub(super) resource: ResourceId,
    /// The version in which it was taken: no other lease of the resource has it.
    pub(super) version: Version,
}

impl Grant {
    /// Whether it is still the agent's, and not one that another agent, or the same one, was granted later.
    pub(super) fn holds(&self, snapshot: &Snapshot, agent: AgentId) -> bool {
        let lease = snapshot.lease(self.resource);
        lease.is_some_and(|lease| lease.holder == agent && lease.claimed == self.version)
    }
}

//! Access to the resources that a rule claims.

use dsr::{Preemption, ResourceId, Snapshot};

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

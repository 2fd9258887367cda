//! One edit: checked (`check`), then written and logged (`State::insert_…`, `State::remove_…` in `state::write`).
//!
//! Invariant: an edit that is rejected leaves the state as it was, except for a rejected claim, which the rollback of
//! its transaction undoes.

use super::edit::Edit;
use super::error::TransactionError;
use super::{check, claim};
use crate::id::{AgentId, Version};
use crate::state::State;

/// Checks an edit of `writer` and writes it in version `since`.
pub(super) fn apply(
    state: &mut State,
    writer: AgentId,
    edit: &Edit,
    since: Version,
) -> Result<(), TransactionError> {
    match edit {
        Edit::AddNode { name, node_type } => {
            let id = check::new_node(state, writer, name, *node_type)?;
            state.insert_node(id, name.clone(), *node_type, since);
        }
        Edit::RemoveNode { node } => {
            let id = check::old_node(state, writer, node)?;
            state.remove_node(id);
        }
        Edit::AddEdge { from, label, to } => {
            let key = check::edge(state, writer, from, *label, to)?;
            state.insert_edge(key, since);
        }
        Edit::RemoveEdge { from, label, to } => {
            let key = check::edge(state, writer, from, *label, to)?;
            state.remove_edge(key);
        }
        Edit::SetAttribute { holder, attribute, value } => {
            let holder = check::holder(state, writer, holder, *attribute)?;
            check::exists(state, holder)?;
            let value = check::value(state, *attribute, value)?;
            state.insert_attribute(holder, *attribute, value, since);
        }
        Edit::ClearAttribute { holder, attribute } => {
            let holder = check::holder(state, writer, holder, *attribute)?;
            state.remove_attribute(holder, *attribute);
        }
        Edit::SetTransform { parent, child, pose } => {
            let (parent, child) = check::pose(state, writer, parent, child, pose)?;
            state.insert_transform(parent, child, pose.clone(), since);
        }
        Edit::SampleTransform { parent, child, time, pose } => {
            let (parent, child) = check::pose(state, writer, parent, child, pose)?;
            state.insert_sample(parent, child, *time, pose.clone(), since);
        }
        Edit::RemoveTransform { parent, child } => {
            let (parent, child) = check::transform(state, writer, parent, child)?;
            if state.joint(child).is_some_and(|joint| joint.parent == parent) {
                state.remove_transform(child);
            }
        }
        Edit::Claim { resource, priority, preemption } => {
            claim::claim(state, writer, *resource, (*priority, *preemption), since)?;
        }
        Edit::Await { resource, priority, preemption } => {
            claim::claim_or_wait(state, writer, *resource, (*priority, *preemption), since)?;
        }
        Edit::Release { resource } => claim::release(state, writer, *resource, since)?,
        Edit::Expire { agent } => {
            check::expiry(state, writer, *agent)?;
            claim::give_up_all(state, *agent, since);
            state.log.expired.push(*agent);
        }
    }
    Ok(())
}

//! Replay: from a state and the deltas after it to the state now, without asking anybody for permission again.
//!
//! Invariant: replaying what a graph published gives its export, byte for byte. A delta that cannot have come
//! after the state it is applied to is an error that names the version, never a panic.

use crate::block::Cell;
use crate::delta::{Change, Delta};
use crate::id::{EdgeKey, Holder, NodeId, Version};
use crate::state::State;
use crate::value::{Kind, Value};

/// Why deltas do not continue a state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReplayError {
    /// The initial state is not one of this dictionary.
    #[error(transparent)]
    Restore(#[from] crate::export::RestoreError),
    /// A version is missing or comes twice.
    #[error("version {} cannot follow version {}", found.0, at.0)]
    Gap {
        /// The version of the state.
        at: Version,
        /// The version of the delta.
        found: Version,
    },
    /// A change does not fit the state.
    #[error("version {}: change {change} does not fit", version.0)]
    Misfit {
        /// The version of the delta.
        version: Version,
        /// The position of the change in it.
        change: usize,
    },
}

/// Applies one delta.
pub(crate) fn apply(state: &mut State, delta: &Delta) -> Result<(), ReplayError> {
    let (at, found) = (state.version, delta.version);
    if Some(found.0) != at.0.checked_add(1) {
        return Err(ReplayError::Gap { at, found });
    }
    let mark = state.mark();
    for (index, change) in delta.changes.iter().enumerate() {
        redo(state, change, found).ok_or(ReplayError::Misfit { version: found, change: index })?;
    }
    crate::transaction::apply::judge(state, mark)
        .map_err(|_| ReplayError::Misfit { version: found, change: delta.changes.len() })?;
    (state.version, state.time) = (found, delta.time);
    state.log.clear();
    Ok(())
}

/// Applies a delta that another copy of the same state made, so that it is known to fit; false if it does not continue
/// the state all the same. Edges and attributes, which is most of what is written, are put where they belong without
/// being looked up first.
pub(crate) fn follow(state: &mut State, delta: &Delta) -> bool {
    let plain = |change: &Change| {
        matches!(
            change,
            Change::EdgeAdded { .. }
                | Change::EdgeRemoved { .. }
                | Change::AttributeAdded { .. }
                | Change::AttributeChanged { .. }
                | Change::AttributeRemoved { .. }
        )
    };
    if delta.version.0 != state.version.0 + 1 || !delta.changes.iter().all(plain) {
        return apply(state, delta).is_ok();
    }
    let since = delta.version;
    for change in &delta.changes {
        match change {
            Change::EdgeAdded { edge } => state.put_edge(*edge, since),
            Change::EdgeRemoved { edge } => state.take_edge(*edge),
            Change::AttributeAdded { holder, attribute, new }
            | Change::AttributeChanged { holder, attribute, new, .. } => {
                let cell = Cell { value: new.clone(), since, attribute: *attribute };
                state.put_cell(*holder, *attribute, Some(cell));
            }
            Change::AttributeRemoved { holder, attribute, .. } => {
                state.put_cell(*holder, *attribute, None);
            }
            _ => return false,
        }
    }
    (state.version, state.time) = (delta.version, delta.time);
    true
}

/// Applies one change, or `None` if the state is not the one before it.
fn redo(state: &mut State, change: &Change, since: Version) -> Option<()> {
    let fits = |found: bool| found.then_some(());
    match change {
        Change::AttributeRemoved { holder, attribute, old } => {
            fits(state.cell(*holder, *attribute)?.value.same(old))?;
            state.remove_attribute(*holder, *attribute);
        }
        Change::EdgeRemoved { edge } => {
            state.edge(*edge)?;
            state.remove_edge(*edge);
        }
        Change::TransformRemoved { parent, child, .. } => {
            fits(state.joint(*child)?.parent == *parent)?;
            state.remove_transform(*child);
        }
        Change::NodeRemoved { node, name, .. } => {
            fits(**state.names.of(*node)? == **name)?;
            state.remove_node(*node);
        }
        Change::NodeAdded { node, name, node_type } => {
            state.dictionary.type_name(*node_type)?;
            fits(*node >= state.next && *node < NodeId::NOWHERE && state.names.get(name).is_none())?;
            state.insert_node(*node, name.clone(), *node_type, since);
        }
        Change::TransformSampled { parent, child, time, new, .. } => {
            fits(new.is_finite())?;
            let joint = state.joint(*child)?;
            fits(joint.parent == *parent && joint.track.is_some())?;
            state.insert_sample(*parent, *child, *time, new.clone(), since);
        }
        Change::TransformAdded { parent, child, new, time } => {
            fits(new.is_finite())?;
            fits(
                state.node(*parent).is_some()
                    && state.node(*child).is_some()
                    && state.joint(*child).is_none()
                    && parent != child,
            )?;
            match time {
                Some(time) => state.insert_sample(*parent, *child, *time, new.clone(), since),
                None => state.insert_transform(*parent, *child, new.clone(), since),
            }
        }
        Change::TransformChanged { parent, child, old, new } => {
            let joint = state.joint(*child)?;
            fits(joint.parent == *parent && joint.pose.same(old) && new.is_finite())?;
            state.insert_transform(*parent, *child, new.clone(), since);
        }
        Change::EdgeAdded { edge } => {
            let EdgeKey { from, label, to } = *edge;
            let (start, end) = (state.node(from)?.node_type(), state.node(to)?.node_type());
            fits(from != to && state.dictionary.allows(label, start, end) && state.edge(*edge).is_none())?;
            state.insert_edge(*edge, since);
        }
        Change::AttributeAdded { holder, attribute, new } => {
            fits(state.cell(*holder, *attribute).is_none())?;
            write(state, *holder, *attribute, new, since)?;
        }
        Change::AttributeChanged { holder, attribute, old, new } => {
            fits(state.cell(*holder, *attribute)?.value.same(old))?;
            write(state, *holder, *attribute, new, since)?;
        }
    }
    Some(())
}

fn write(
    state: &mut State,
    holder: Holder,
    attribute: crate::id::AttributeId,
    value: &Value,
    since: Version,
) -> Option<()> {
    let kind = state.dictionary.kind(attribute)?;
    match (kind, value) {
        (Kind::Number, Value::Number(number)) => number.is_finite().then_some(())?,
        (Kind::Text, Value::Text(_)) | (Kind::Bool, Value::Bool(_)) | (Kind::Node(_), Value::Node(_)) => {}
        _ => return None,
    }
    match holder {
        Holder::Node(node) => state.node(node).map(|_| ())?,
        Holder::Edge(key) => state.edge(key).map(|_| ())?,
    }
    if let Value::Node(target) = value {
        state.node(*target)?;
    }
    state.insert_attribute(holder, attribute, value.clone(), since);
    Some(())
}

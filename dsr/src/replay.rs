//! Replay: from a state and the deltas after it to the present state, without checking permissions again.
//!
//! Invariant: replaying what a graph published gives its export, byte for byte. A delta that cannot follow the state to
//! which it is applied gives an error with its version, never a panic.

use crate::block::Cell;
use crate::delta::{Change, Delta};
use crate::id::{AttributeId, Holder, NodeId, TypeId, Version};
use crate::lease;
use crate::replay_check::{edge_fits, pose_fits, value_fits};
use crate::state::State;
use crate::state::log::Mark;
use crate::transaction::invariants;
use crate::value::Value;

/// Why a delta cannot follow a state.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ReplayError {
    /// The initial state is invalid for this vocabulary.
    #[error(transparent)]
    Restore(#[from] crate::export::RestoreError),
    /// A version is missing or repeated.
    #[error("version {} cannot follow version {}", found.0, at.0)]
    Gap {
        /// The version of the state.
        at: Version,
        /// The version of the delta.
        found: Version,
    },
    /// A change cannot be applied to the state.
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
    let done = redo_all(state, delta, mark);
    if done.is_err() {
        state.roll_back(mark);
    } else {
        (state.version, state.time) = (found, delta.time);
        for change in &delta.changes {
            if let Change::TransformSampled { child, .. } = change {
                state.evict(*child);
            }
        }
    }
    state.log.clear();
    done
}

fn redo_all(state: &mut State, delta: &Delta, mark: Mark) -> Result<(), ReplayError> {
    let version = delta.version;
    for (change, what) in delta.changes.iter().enumerate() {
        redo(state, what, version).ok_or(ReplayError::Misfit { version, change })?;
    }
    let as_a_whole = ReplayError::Misfit { version, change: delta.changes.len() };
    invariants::check(state, mark).map_err(|_| as_a_whole.clone())?;
    if state.log.mentions.leases() && !lease::are_sound(state) { Err(as_a_whole) } else { Ok(()) }
}

/// Applies a delta that was made on a copy of this state, and so is known to fit. Returns false if it does not follow
/// the state. Changes of edges and attributes, the most frequent ones, are written without looking up the old value.
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

/// Applies one change; `None` if it cannot follow the state.
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
            fits(
                state.vocabulary.agent_of(*node).is_none() && state.vocabulary.resource_of(*node).is_none(),
            )?;
            fits(**state.names.of(*node)? == **name)?;
            state.remove_node(*node);
        }
        Change::NodeAdded { node, name, node_type } => {
            state.vocabulary.type_name(*node_type)?;
            fits(*node_type != TypeId::AGENT && *node_type != TypeId::RESOURCE && !name.is_empty())?;
            fits(*node >= state.next && *node < NodeId::NOWHERE && state.names.get(name).is_none())?;
            state.insert_node(*node, name.clone(), *node_type, since);
        }
        Change::TransformSampled { parent, child, time, new, .. } => {
            fits(pose_fits(state, *parent, *child, new))?;
            let joint = state.joint(*child)?;
            fits(joint.parent == *parent && joint.track.is_some())?;
            state.insert_sample(*parent, *child, *time, new.clone(), since);
        }
        Change::TransformAdded { parent, child, new, time } => {
            fits(pose_fits(state, *parent, *child, new) && state.joint(*child).is_none())?;
            match time {
                Some(time) => state.insert_sample(*parent, *child, *time, new.clone(), since),
                None => state.insert_transform(*parent, *child, new.clone(), since),
            }
        }
        Change::TransformChanged { parent, child, old, new } => {
            let joint = state.joint(*child)?;
            fits(joint.parent == *parent && joint.track.is_none() && joint.pose.same(old))?;
            fits(pose_fits(state, *parent, *child, new))?;
            state.insert_transform(*parent, *child, new.clone(), since);
        }
        Change::EdgeAdded { edge } => {
            fits(edge_fits(state, *edge))?;
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
    attribute: AttributeId,
    value: &Value,
    since: Version,
) -> Option<()> {
    value_fits(state, holder, attribute, value).then_some(())?;
    state.insert_attribute(holder, attribute, value.clone(), since);
    Some(())
}

#[cfg(test)]
mod tests {
    use nalgebra::Isometry3;

    use crate::graph::Graph;
    use crate::id::{AgentId, Time};
    use crate::vocabulary::{Nature, VocabularyBuilder};

    /// Two sensors in turn: each of the two states, and a replay, gets half or all of the samples through deltas.
    #[test]
    fn invisible_samples_are_freed_wherever_a_delta_is_applied() {
        let mut builder = VocabularyBuilder::new();
        let place = builder.node_type("place", None, Nature::Geometric).expect("a new type");
        let graph = Graph::new(builder.build());
        let set_up = |tx: &mut crate::Transaction| {
            tx.add_node("world", place).add_node("one", place).add_node("two", place);
        };
        graph.edit(AgentId::DSR, Time(0), set_up).expect("new nodes");
        let (first, mut deltas) = (graph.snapshot().export(), Vec::new());
        let most = |graph: &Graph| {
            let now = graph.snapshot();
            let tracks = ["one", "two"].map(|name| now.state().joint(now.node(name)?)?.track.clone());
            tracks.into_iter().flatten().map(|track| track.chunks()).max()
        };
        for at in 0..4_000 {
            let child = if at % 2 == 0 { "one" } else { "two" };
            let time = Time(at * 20_000_000);
            let sample = |tx: &mut crate::Transaction| {
                tx.sample_transform("world", child, time, Isometry3::translation(1.0, 0.0, 0.0));
            };
            deltas.push((*graph.edit(AgentId::DSR, time, sample).expect("a sample").delta).clone());
            // 250 samples of ten seconds are eight chunks of 32, and one at either end.
            assert!(most(&graph) <= Some(10), "{:?} after {at} samples", most(&graph));
        }
        let replayed = Graph::replay(graph.vocabulary(), &first, &deltas).expect("as it was");
        assert!(most(&replayed) <= Some(10));
        assert_eq!(replayed.snapshot().export(), graph.snapshot().export());
    }
}

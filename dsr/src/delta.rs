//! What a commit changed: the difference between two states, not the list of its edits.
//!
//! Problem: a log of edits says "added" for what existed before, and "removed" for what was added again a line later.
//! Idea: compare, once for each thing that was edited, the value that the log kept from before with the value now. A
//! thing that is equal to the bit keeps its old `since`; the others are changes. Invariant: applying the changes in
//! their order to the state before gives the state after, to the byte (see `replay`). Cost: linear in the number of
//! edits.

use std::sync::Arc;

use rustc_hash::FxHashSet;
use serde::{Deserialize, Serialize};

use crate::block::Joint;
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, ReflexId, Time, TypeId, Version};
use crate::mentions::Mentions;
use crate::pose::Pose;
use crate::state::log::Undo;
use crate::state::{Kept, State};
use crate::track::Sample;
use crate::value::Value;

/// One difference between two states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum Change {
    /// An attribute was removed, alone or with its holder.
    AttributeRemoved { holder: Holder, attribute: AttributeId, old: Value },
    /// An edge was removed.
    EdgeRemoved { edge: EdgeKey },
    /// The transform from a child to its parent was removed.
    TransformRemoved { parent: NodeId, child: NodeId, old: Pose },
    /// A node was removed.
    NodeRemoved { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A node was added.
    NodeAdded { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A child got a transform to a parent.
    TransformAdded {
        parent: NodeId,
        child: NodeId,
        new: Pose,
        /// The time of the first sample of a moving child; `None` for a static pose.
        #[serde(default)]
        time: Option<Time>,
    },
    /// The static pose of a child in its parent changed.
    TransformChanged { parent: NodeId, child: NodeId, old: Pose, new: Pose },
    /// A moving child got a pose at a time.
    TransformSampled { parent: NodeId, child: NodeId, time: Time, old: Option<Pose>, new: Pose },
    /// An edge was added.
    EdgeAdded { edge: EdgeKey },
    /// An attribute got a value.
    AttributeAdded { holder: Holder, attribute: AttributeId, new: Value },
    /// The value of an attribute changed.
    AttributeChanged { holder: Holder, attribute: AttributeId, old: Value, new: Value },
}

impl Change {
    /// The order of changes in a delta. Removals come first, each after the removals of what depends on it; then
    /// additions, each after what it depends on. Within a rank they are sorted by node, with its own attributes before
    /// those of its edges.
    pub(crate) fn order(&self) -> (u8, NodeId, Option<(LabelId, NodeId)>, u64, Option<AttributeId>) {
        let of = |rank, holder: &Holder, added: bool, attribute: &AttributeId| match holder {
            Holder::Node(node) => (rank, *node, None, added.into(), Some(*attribute)),
            Holder::Edge(key) => (rank, key.from, Some((key.label, key.to)), added.into(), Some(*attribute)),
        };
        match self {
            Self::AttributeRemoved { holder, attribute, .. } => of(0, holder, false, attribute),
            Self::EdgeRemoved { edge } => (1, edge.from, Some((edge.label, edge.to)), 0, None),
            Self::TransformRemoved { child, .. } => (2, *child, None, 0, None),
            Self::NodeRemoved { node, .. } => (3, *node, None, 0, None),
            Self::NodeAdded { node, .. } => (4, *node, None, 0, None),
            Self::TransformAdded { child, .. } | Self::TransformChanged { child, .. } => {
                (5, *child, None, 0, None)
            }
            // After the first sample, which adds the transform.
            Self::TransformSampled { child, time, .. } => (5, *child, None, time.0.saturating_add(1), None),
            Self::EdgeAdded { edge } => (6, edge.from, Some((edge.label, edge.to)), 0, None),
            Self::AttributeChanged { holder, attribute, .. } => of(7, holder, false, attribute),
            Self::AttributeAdded { holder, attribute, .. } => of(7, holder, true, attribute),
        }
    }
}

/// What one commit changed. Serialisable: journals store it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Delta {
    /// The version that the commit made.
    pub version: Version,
    /// The time of the commit, as the committer gave it.
    pub time: Time,
    /// The agent that committed. The edits of reflexes are those of their owners.
    pub writer: AgentId,
    /// The changes, in an order in which they can be applied.
    pub changes: Vec<Change>,
    /// The reflexes that fired, in order.
    pub reflexes: Vec<ReflexId>,
}

impl Mentions {
    /// The tokens that a delta changes.
    pub fn of(delta: &Delta) -> Self {
        let mut mentions = Self::default();
        for change in &delta.changes {
            match change {
                Change::NodeAdded { node_type, .. } | Change::NodeRemoved { node_type, .. } => {
                    mentions.add_type(*node_type);
                }
                Change::EdgeAdded { edge } | Change::EdgeRemoved { edge } => mentions.add_label(edge.label),
                Change::AttributeAdded { attribute, .. }
                | Change::AttributeChanged { attribute, .. }
                | Change::AttributeRemoved { attribute, .. } => mentions.add_attribute(*attribute),
                Change::TransformAdded { .. }
                | Change::TransformChanged { .. }
                | Change::TransformSampled { .. }
                | Change::TransformRemoved { .. } => mentions.add_transforms(),
            }
        }
        mentions
    }
}

/// The thing that an entry of the log is about.
#[derive(PartialEq, Eq, Hash)]
enum Thing {
    Node(NodeId),
    Edge(EdgeKey),
    Cell(Holder, AttributeId),
    Joint(NodeId),
    Sample(NodeId, Time),
}

impl Thing {
    fn of(entry: &Undo) -> Self {
        match entry {
            Undo::NodeAdded(node) | Undo::NodeRemoved { node, .. } => Self::Node(*node),
            Undo::EdgeAdded(edge) | Undo::EdgeRemoved { edge, .. } => Self::Edge(*edge),
            Undo::Cell { holder, attribute, .. } => Self::Cell(*holder, *attribute),
            Undo::Joint { child, .. } => Self::Joint(*child),
            Undo::Sample { child, time, .. } => Self::Sample(*child, *time),
        }
    }
}

/// Logs up to this length are searched instead of hashed.
const SHORT: usize = 16;

/// Compares the log with the state. Restores the `since` of each thing that has not changed, and returns the changes.
pub(crate) fn settle(after: &mut State) -> Vec<Change> {
    let entries = std::mem::take(&mut after.log.entries);
    let mut changes = Vec::with_capacity(entries.len());
    let mut seen = FxHashSet::default();
    // A transform that was added in this transaction, or removed and added, is reported as a whole with all its poses.
    let hung: FxHashSet<_> = entries
        .iter()
        .filter_map(|entry| if let Undo::Joint { child, .. } = entry { Some(*child) } else { None })
        .collect();
    for (at, entry) in entries.iter().enumerate() {
        if let Undo::Sample { child, .. } = entry
            && hung.contains(child)
        {
            continue;
        }
        // The first entry about a thing has its value before the transaction.
        let first = if entries.len() <= SHORT {
            let thing = Thing::of(entry);
            entries[..at].iter().all(|earlier| Thing::of(earlier) != thing)
        } else {
            seen.insert(Thing::of(entry))
        };
        if first {
            compare(after, entry, &entries[..at], &mut changes);
        }
    }
    for entry in &entries {
        if let Undo::Sample { child, .. } = entry {
            after.evict(*child);
        }
    }
    after.log.entries = entries;
    if !changes.is_sorted_by_key(Change::order) {
        changes.sort_by_key(Change::order);
    }
    changes
}

/// Compares the first entry about a thing with the state. `earlier` are the entries before it.
fn compare(after: &mut State, first: &Undo, earlier: &[Undo], changes: &mut Vec<Change>) {
    match first {
        Undo::NodeAdded(node) => {
            if let Some(found) = after.node(*node) {
                let (node_type, name) = (found.node_type(), after.name(*node));
                changes.push(Change::NodeAdded { node: *node, name, node_type });
            }
        }
        Undo::NodeRemoved { node, name, node_type, .. } => {
            changes.push(Change::NodeRemoved { node: *node, name: name.clone(), node_type: *node_type });
        }
        Undo::EdgeAdded(edge) => {
            if after.edge(*edge).is_some() {
                changes.push(Change::EdgeAdded { edge: *edge });
            }
        }
        Undo::EdgeRemoved { edge, since } => match after.edge(*edge) {
            Some(_) => after.keep_since(Kept::Edge(*edge), *since),
            None => changes.push(Change::EdgeRemoved { edge: *edge }),
        },
        Undo::Cell { holder, attribute, old } => {
            compare_cells(after, *holder, *attribute, old.as_ref(), changes);
        }
        Undo::Joint { child, old } => compare_joints(after, *child, old.as_ref(), earlier, changes),
        Undo::Sample { child, time, old, newest, since } => {
            let Some(joint) = after.joint(*child) else { return };
            let Some(track) = &joint.track else { return };
            let Some(new) = track.sample(*time) else { return };
            let same = old.as_ref().is_some_and(|old| old.same(new));
            if same && *time == track.newest() && joint.pose.same(newest) {
                after.keep_since(Kept::Joint(*child), *since);
            } else if !same && *time >= track.horizon() {
                let (parent, old, new) = (joint.parent, old.clone(), new.clone());
                changes.push(Change::TransformSampled { parent, child: *child, time: *time, old, new });
            }
        }
    }
}

fn compare_joints(
    after: &mut State,
    child: NodeId,
    old: Option<&Joint>,
    earlier: &[Undo],
    changes: &mut Vec<Change>,
) {
    let (Some(old), Some(new)) = (old, after.joint(child)) else {
        return replace_joint(child, old, after.joint(child), changes);
    };
    let stays = old.parent == new.parent;
    let stand = old.track.is_none() && new.track.is_none();
    // `old` has the samples from before the transaction only if the transaction did not add a sample before it.
    let sampled = |entry: &Undo| matches!(entry, Undo::Sample { child: other, .. } if *other == child);
    if stays && stand && old.pose.same(&new.pose)
        || stays && same_samples(old, new) && !earlier.iter().any(sampled)
    {
        after.keep_since(Kept::Joint(child), old.since);
    } else if stays && stand {
        let (old, parent, new) = (old.pose.clone(), new.parent, new.pose.clone());
        changes.push(Change::TransformChanged { parent, child, old, new });
    } else {
        replace_joint(child, Some(old), Some(new), changes);
    }
}

/// Whether both are moving, with equal samples.
fn same_samples(old: &Joint, new: &Joint) -> bool {
    let (Some(old), Some(new)) = (&old.track, &new.track) else { return false };
    let same = |(a, b): (&Sample, &Sample)| a.time == b.time && a.pose.same(&b.pose);
    old.samples().count() == new.samples().count() && old.samples().zip(new.samples()).all(same)
}

/// The changes that replace one transform of a child by another; either may be absent.
pub(crate) fn replace_joint(
    child: NodeId,
    old: Option<&Joint>,
    new: Option<&Joint>,
    changes: &mut Vec<Change>,
) {
    if let Some(old) = old {
        let (parent, old) = (old.parent, old.pose.clone());
        changes.push(Change::TransformRemoved { parent, child, old });
    }
    let Some(new) = new else { return };
    let parent = new.parent;
    let Some(track) = &new.track else {
        changes.push(Change::TransformAdded { parent, child, new: new.pose.clone(), time: None });
        return;
    };
    for (at, sample) in track.samples().enumerate() {
        let (time, new) = (sample.time, sample.pose.clone());
        changes.push(if at == 0 {
            Change::TransformAdded { parent, child, new, time: Some(time) }
        } else {
            Change::TransformSampled { parent, child, time, old: None, new }
        });
    }
}

fn compare_cells(
    after: &mut State,
    holder: Holder,
    attribute: AttributeId,
    old: Option<&(Value, Version)>,
    changes: &mut Vec<Change>,
) {
    let new = after.cell(holder, attribute).map(|cell| cell.value.clone());
    match (old.cloned(), new) {
        (None, None) => {}
        (None, Some(new)) => changes.push(Change::AttributeAdded { holder, attribute, new }),
        (Some((old, _)), None) => changes.push(Change::AttributeRemoved { holder, attribute, old }),
        (Some((old, since)), Some(new)) if new.same(&old) => {
            after.keep_since(Kept::Cell(holder, attribute), since);
        }
        (Some((old, _)), Some(new)) => {
            replace_value(after, holder, attribute, (old, new), changes);
        }
    }
}

/// The changes that replace one value of an attribute by another. Changes are applied after the removals of nodes, and
/// removing a node removes the attributes that refer to it: an attribute that referred to a removed node is therefore
/// removed and added.
pub(crate) fn replace_value(
    after: &State,
    holder: Holder,
    attribute: AttributeId,
    (old, new): (Value, Value),
    changes: &mut Vec<Change>,
) {
    if old.as_node().is_some_and(|target| after.node(target).is_none()) {
        changes.push(Change::AttributeRemoved { holder, attribute, old });
        changes.push(Change::AttributeAdded { holder, attribute, new });
    } else {
        changes.push(Change::AttributeChanged { holder, attribute, old, new });
    }
}

//! What a commit changed: the difference between two states, never the list of what was asked.
//!
//! Problem: a log of requested edits says "added" for what was there and "removed" for what was put back a line
//! later. Idea: hold what the log says was there before the transaction against what is there now, once per thing
//! touched. What is the same to the bit keeps its old `since`; the rest is a change. Invariant: applying the changes
//! in their order to the state before gives the state after, to the byte (see `replay`). Cost: linear in what was
//! edited.

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
    /// An attribute went, alone or with its holder.
    AttributeRemoved { holder: Holder, attribute: AttributeId, old: Value },
    /// An edge went.
    EdgeRemoved { edge: EdgeKey },
    /// A child was taken off its parent.
    TransformRemoved { parent: NodeId, child: NodeId, old: Pose },
    /// A node went.
    NodeRemoved { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A node came.
    NodeAdded { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A child was hung below a parent.
    TransformAdded {
        parent: NodeId,
        child: NodeId,
        new: Pose,
        /// When it was there; `None` for a pose that stands until it is changed.
        #[serde(default)]
        time: Option<Time>,
    },
    /// A child moved relative to its parent.
    TransformChanged { parent: NodeId, child: NodeId, old: Pose, new: Pose },
    /// A child was elsewhere relative to its parent at that time.
    TransformSampled { parent: NodeId, child: NodeId, time: Time, old: Option<Pose>, new: Pose },
    /// An edge came.
    EdgeAdded { edge: EdgeKey },
    /// An attribute was given a value.
    AttributeAdded { holder: Holder, attribute: AttributeId, new: Value },
    /// An attribute was given another value.
    AttributeChanged { holder: Holder, attribute: AttributeId, old: Value, new: Value },
}

impl Change {
    /// Changes are listed by rank: what goes first, what it hung on after it; then what comes, after what it
    /// hangs on. Within a rank by node, its own attributes before those of its edges.
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
            // After the first one, which brings the edge.
            Self::TransformSampled { child, time, .. } => (5, *child, None, time.0.saturating_add(1), None),
            Self::EdgeAdded { edge } => (6, edge.from, Some((edge.label, edge.to)), 0, None),
            Self::AttributeChanged { holder, attribute, .. } => of(7, holder, false, attribute),
            Self::AttributeAdded { holder, attribute, .. } => of(7, holder, true, attribute),
        }
    }
}

/// What one commit changed. Serialisable: the entry of a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Delta {
    /// The version that the commit made.
    pub version: Version,
    /// The time that the committer gave.
    pub time: Time,
    /// Who committed. Reflexes wrote as their owners.
    pub writer: AgentId,
    /// The differences, in an order in which they can be applied.
    pub changes: Vec<Change>,
    /// The reflexes that fired, in the order in which they did.
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

/// What an entry of the log is about.
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

/// Logs up to this length are searched rather than hashed.
const SHORT: usize = 16;

/// Holds what was overwritten against what is there now, gives what stayed its old `since`, and lists the rest.
pub(crate) fn settle(after: &mut State) -> Vec<Change> {
    let entries = std::mem::take(&mut after.log.entries);
    let mut changes = Vec::with_capacity(entries.len());
    let mut seen = FxHashSet::default();
    // An edge that came in this transaction, or went and came, is told as a whole with all its poses.
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
        // The first entry about a thing has what was there before the transaction.
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

/// Holds the first entry about a thing, and with it those before, against what is there now.
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
    // What the edge remembered before the transaction is told by `old` only if it was not sampled first.
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

/// Whether both move, and remember the same.
fn same_samples(old: &Joint, new: &Joint) -> bool {
    let (Some(old), Some(new)) = (&old.track, &new.track) else { return false };
    let same = |(a, b): (&Sample, &Sample)| a.time == b.time && a.pose.same(&b.pose);
    old.samples().count() == new.samples().count() && old.samples().zip(new.samples()).all(same)
}

/// What it takes to go from one joint of a node to another, or none.
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

/// What it takes to go from one value of an attribute to another. It goes with the node that it names, and changes are
/// applied after nodes have gone: then it went and came back.
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

//! What the transaction in progress has overwritten.
//!
//! Idea: a state is edited in place, and each edit first logs what it overwrites. Rolling back plays the log backwards
//! (`rollback`). Publishing compares, for each thing edited, the first entry (the value before) with the state (the
//! value now) to make the delta (`delta`). Invariant: the log of a published state is empty.

use std::sync::Arc;

use crate::block::Joint;
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::mentions::Mentions;
use crate::pose::Pose;
use crate::value::Value;

/// What one edit overwrote.
#[derive(Debug)]
pub(crate) enum Undo {
    /// The node did not exist.
    NodeAdded(NodeId),
    /// The node existed; its edges, attributes and transforms had been removed before.
    NodeRemoved { node: NodeId, name: Arc<str>, node_type: TypeId, since: Version },
    /// The edge did not exist.
    EdgeAdded(EdgeKey),
    /// The edge existed; its attributes had been removed before.
    EdgeRemoved { edge: EdgeKey, since: Version },
    /// The attribute had this value, or none.
    Cell { holder: Holder, attribute: AttributeId, old: Option<(Value, Version)> },
    /// The node had this transform to its parent, or none.
    Joint { child: NodeId, old: Option<Joint> },
    /// The track of a moving frame had this pose at that time, or none; its newest pose was `newest`.
    Sample { child: NodeId, time: Time, old: Option<Pose>, newest: Pose, since: Version },
}

/// A point in the log to roll back to: the start of a transaction or of a reflex.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mark {
    pub(super) entries: usize,
    pub(super) next: NodeId,
    pub(super) root: Option<NodeId>,
    pub(super) expired: usize,
}

impl Mark {
    /// The id that the next new node would have had.
    pub(crate) fn next(self) -> NodeId {
        self.next
    }
}

/// The log of a state.
#[derive(Debug, Default)]
pub(crate) struct Log {
    pub(crate) entries: Vec<Undo>,
    /// The tokens edited, including those of edits that were rolled back.
    pub(crate) mentions: Mentions,
    /// The agents that have expired in this transaction.
    pub(crate) expired: Vec<AgentId>,
}

/// The log belongs to the state that is being edited, so a copy starts with an empty one.
impl Clone for Log {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Log {
    /// The entries since a mark.
    pub(crate) fn since(&self, mark: Mark) -> &[Undo] {
        &self.entries[mark.entries..]
    }

    pub(crate) fn clear(&mut self) {
        self.entries.clear();
        // A transaction that sets up a world makes a long log; the small ones after it do not need its memory.
        self.entries.shrink_to(256);
        self.mentions.clear();
        self.expired.clear();
    }
}

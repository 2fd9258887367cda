//! What the transaction in progress has overwritten: the way back, and the before-image of its delta.
//!
//! Idea: a state is edited in place, and each raw edit first writes down what was there. Dropping a transaction
//! plays the log backwards; publishing one reads, per thing touched, the first entry (what was) against the state
//! (what is). Invariant: the log is empty in every published state, and after a roll-back the state is the one of
//! the mark, to the byte. A reflex that cannot write goes back to its own mark, not to the start.

use crate::block::{Cell, Joint};
use crate::id::{AttributeId, EdgeKey, Holder, NodeId, Time, TypeId, Version};
use crate::mentions::Mentions;
use crate::pose::Pose;
use crate::reflex::Registry;
use crate::state::State;
use crate::value::Value;

/// What a raw edit overwrote.
#[derive(Debug)]
pub(crate) enum Undo {
    /// The node was not there.
    NodeAdded(NodeId),
    /// The node was there, with nothing left on it.
    NodeRemoved { node: NodeId, name: std::sync::Arc<str>, node_type: TypeId, since: Version },
    /// The edge was not there.
    EdgeAdded(EdgeKey),
    /// The edge was there, with nothing left on it.
    EdgeRemoved { edge: EdgeKey, since: Version },
    /// The attribute had this value.
    Cell { holder: Holder, attribute: AttributeId, old: Option<(Value, Version)> },
    /// The node hung there.
    Joint { child: NodeId, old: Option<Joint> },
    /// The buffer had this at that time, and the newest pose was this.
    Sample { child: NodeId, time: Time, old: Option<Pose>, newest: Pose, since: Version },
}

/// Where the state was when a transaction or a reflex began.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Mark {
    entries: usize,
    next: NodeId,
    root: Option<NodeId>,
    condemned: usize,
}

impl Mark {
    /// The id that the next new node would have got.
    pub(crate) fn next(self) -> NodeId {
        self.next
    }
}

#[derive(Debug, Default)]
pub(crate) struct Log {
    pub(crate) entries: Vec<Undo>,
    /// The tokens touched, by what was rolled back too.
    pub(crate) mentions: Mentions,
    /// Where the transaction in progress began, with the reflexes of then.
    begun: Option<(Mark, Registry)>,
}

/// The log belongs to the state that is being edited; a copy starts with an empty one.
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
        // The log of a transaction that set up a world is not kept for the small ones after it.
        self.entries.shrink_to(256);
        self.mentions.clear();
        self.begun = None;
    }
}

impl State {
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            entries: self.log.entries.len(),
            next: self.next,
            root: self.root,
            condemned: self.reflexes.condemned(),
        }
    }

    /// Begins a transaction.
    pub(crate) fn begin(&mut self) -> Mark {
        let mark = self.mark();
        self.log.begun = Some((mark, self.reflexes.clone()));
        mark
    }

    /// Back to the state in which the transaction in progress began, if there is one.
    pub(crate) fn abandon(&mut self) {
        if let Some((mark, reflexes)) = self.log.begun.take() {
            self.roll_back(mark);
            self.reflexes = reflexes;
            self.log.clear();
        }
    }

    /// Back to a mark of the transaction in progress; its reflexes stay registered.
    pub(crate) fn roll_back(&mut self, mark: Mark) {
        while self.log.entries.len() > mark.entries
            && let Some(entry) = self.log.entries.pop()
        {
            self.undo(entry);
        }
        (self.next, self.root) = (mark.next, mark.root);
        self.reflexes.forget_condemned(mark.condemned);
    }

    fn undo(&mut self, entry: Undo) {
        match entry {
            Undo::NodeAdded(node) => {
                self.take_node(node);
            }
            Undo::NodeRemoved { node, name, node_type, since } => self.put_node(node, name, node_type, since),
            Undo::EdgeAdded(edge) => self.take_edge(edge),
            Undo::EdgeRemoved { edge, since } => self.put_edge(edge, since),
            Undo::Cell { holder, attribute, old } => {
                let cell = old.map(|(value, since)| Cell { value, since, attribute });
                self.put_cell(holder, attribute, cell);
            }
            Undo::Joint { child, old } => {
                self.put_joint(child, old);
            }
            Undo::Sample { child, time, old, newest, since } => {
                self.restore_sample(child, time, old, newest, since);
            }
        }
    }
}

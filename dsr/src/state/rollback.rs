//! Undoing edits.
//!
//! Invariant: after a rollback the state is the one of the mark, to the byte. A reflex that cannot write rolls back to
//! its own mark, not to the start of the transaction.

use super::State;
use super::log::{Mark, Undo};
use crate::block::Cell;

impl State {
    /// The present point in the log.
    pub(crate) fn mark(&self) -> Mark {
        Mark {
            entries: self.log.entries.len(),
            next: self.next,
            root: self.root,
            expired: self.log.expired.len(),
        }
    }

    /// Undoes every edit since the mark.
    pub(crate) fn roll_back(&mut self, mark: Mark) {
        while self.log.entries.len() > mark.entries
            && let Some(entry) = self.log.entries.pop()
        {
            self.undo(entry);
        }
        (self.next, self.root) = (mark.next, mark.root);
        self.log.expired.truncate(mark.expired);
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

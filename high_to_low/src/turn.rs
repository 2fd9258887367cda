//! One turn of a refinement: what it sees, and what it asks for.

use dsr::{Edit, Snapshot, Time};

use crate::event::RefinementEvent;

/// What the tree of tasks reads and writes while it is stepped.
pub(crate) struct Turn<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) now: Time,
    pub(crate) edits: &'a mut Vec<Edit>,
    pub(crate) events: &'a mut Vec<RefinementEvent>,
    /// The earliest deadline that a part of the tree waits for.
    pub(crate) wake_at: Option<Time>,
}

impl Turn<'_> {
    /// Asks to be stepped at `at` even if the graph does not change.
    pub(crate) fn wake(&mut self, at: Time) {
        self.wake_at = Some(self.wake_at.map_or(at, |earlier| earlier.min(at)));
    }
}

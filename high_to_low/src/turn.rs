//! One turn of a refinement: the snapshot that it reads, and the edits and events that it collects.

use dsr::{Edit, Snapshot, Time};

use crate::event::RefinementEvent;

/// The input and the output of a step, shared by the whole tree of tasks.
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

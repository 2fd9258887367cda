//! One turn of a refinement: the snapshot that it reads, and the edits and events that it collects.
//!
//! Problem: a process that was stopped for nine seconds finds a deadline behind it, and the report that would have met
//! the deadline still in its queue. Idea: a turn has two times. What is *judged* is judged by the time up to which the
//! graph has been seen; what *begins* begins now. Invariant: a deadline passes only when everything that was committed
//! up to it, that instant included, is in the snapshot.

use dsr::{Edit, Snapshot, Time};

use crate::event::RefinementEvent;

/// As long as the finest tick of a timer: the wait after a deadline until every commit of its instant is there.
const TICK: u64 = 1_000_000;

/// When a refinement is stepped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moment {
    /// Every commit up to this time is in the snapshot.
    pub seen: Time,
    /// The time; what begins in this turn begins now. Never before `seen`.
    pub now: Time,
}

impl Moment {
    /// The graph has been seen up to now.
    pub fn at(now: Time) -> Self {
        Self { seen: now, now }
    }
}

/// The input and the output of a step, shared by the whole tree of tasks.
pub(crate) struct Turn<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) moment: Moment,
    pub(crate) edits: &'a mut Vec<Edit>,
    pub(crate) events: &'a mut Vec<RefinementEvent>,
    /// The earliest deadline that a part of the tree waits for.
    pub(crate) wake_at: Option<Time>,
}

impl Turn<'_> {
    /// Asks to be stepped right after `deadline` even if the graph does not change.
    pub(crate) fn wake_after(&mut self, deadline: Time) {
        let at = Time(deadline.0.saturating_add(TICK));
        self.wake_at = Some(self.wake_at.map_or(at, |earlier| earlier.min(at)));
    }
}

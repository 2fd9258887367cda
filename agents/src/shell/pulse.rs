//! What a life of an agent reports to its supervisor: its pulse, its absence, and why it ended.

use dsr::LabelId;
use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use tokio::sync::Notify;

/// The token by which the graph says that an agent is absent: `(LABEL agent STATE)`, as `(is speech absent)`.
#[derive(Debug, Clone)]
pub struct Absence {
    /// The label.
    pub label: LabelId,
    /// The name of the node at its end.
    pub state: Arc<str>,
}

/// Why a life ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Gone {
    /// Its loop panicked.
    Panicked,
    /// Its loop no longer turned.
    Hung,
    /// Somebody else declared it dead, or attended it.
    Fenced,
    /// There was no thread for it.
    NoThread,
}

impl fmt::Display for Gone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Panicked => "it panicked",
            Self::Hung => "it no longer turned",
            Self::Fenced => "it was declared dead",
            Self::NoThread => "there was no thread for it",
        })
    }
}

/// Lets a watchdog see whether a loop turns.
#[derive(Debug, Default)]
pub(super) struct Pulse {
    asked: AtomicU64,
    answered: AtomicU64,
    wake: Arc<Notify>,
}

impl Pulse {
    /// What wakes the loop.
    pub(super) fn wake(&self) -> &Arc<Notify> {
        &self.wake
    }

    /// The loop turns.
    pub(super) fn beat(&self) {
        self.answered.store(self.asked.load(Ordering::Acquire), Ordering::Release);
    }

    /// Asks the loop to turn. Returns whether it has turned since it was asked last.
    pub(super) fn ask(&self) -> bool {
        let answered = self.answered.load(Ordering::Acquire) == self.asked.load(Ordering::Acquire);
        self.asked.fetch_add(1, Ordering::AcqRel);
        self.wake.notify_one();
        answered
    }
}

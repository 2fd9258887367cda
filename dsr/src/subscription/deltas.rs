//! Subscriptions to every commit.

use std::sync::Arc;

use super::queue::{Committed, Queue, Told, Waker};
use crate::snapshot::Snapshot;

/// An event of a subscription to all deltas.
#[derive(Debug, Clone)]
pub enum Event {
    /// The next commit.
    Committed(Committed),
    /// Commits were dropped because the queue was full. The next event follows this state.
    Lagged {
        /// The number of commits that were dropped, including the one of this state.
        missed: u64,
        /// The state from which to continue.
        snapshot: Snapshot,
    },
}

impl Event {
    /// The state after the event.
    pub fn snapshot(&self) -> &Snapshot {
        match self {
            Self::Committed(committed) => &committed.snapshot,
            Self::Lagged { snapshot, .. } => snapshot,
        }
    }
}

/// Every commit from the one after [`Deltas::start`] on.
pub struct Deltas {
    queue: Arc<Queue>,
}

impl Deltas {
    pub(crate) fn new(queue: Arc<Queue>) -> Self {
        Self { queue }
    }

    /// The state before the first event. `None` after the first event was read, or when the queue has overflowed: a
    /// subscriber that does not read must not keep an old state in memory.
    pub fn start(&self) -> Option<Snapshot> {
        self.queue.start()
    }

    /// The next event, if one is waiting.
    pub fn try_recv(&self) -> Option<Event> {
        self.queue.try_recv().map(event)
    }

    /// Waits for the next event; `None` after all handles of the graph were dropped.
    pub fn recv(&self) -> Option<Event> {
        self.queue.recv().map(event)
    }

    /// Calls `wake` whenever there may be something to receive, and at once if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether no event will ever come again.
    pub fn is_closed(&self) -> bool {
        self.queue.is_closed()
    }
}

/// As the event of a subscription to all deltas, which receives commits one by one.
fn event(told: Told) -> Event {
    match told {
        Told::Commits(deltas, snapshot) => match deltas.into_iter().next() {
            Some(delta) => Event::Committed(Committed { delta, snapshot }),
            None => Event::Lagged { missed: 0, snapshot },
        },
        Told::Lagged { missed, snapshot } => Event::Lagged { missed, snapshot },
    }
}

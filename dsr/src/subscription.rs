//! Subscriptions: who wants to know gets told, and nobody ever waits for who does not listen.
//!
//! Idea: a commit only puts a reference to the new state into the queues whose pattern it may concern; the
//! subscriber matches, on its own thread and in its own time. Overflow policy: a queue holds at most its capacity;
//! when full, what is in it is dropped, the subscriber is marked as lagging and goes on from the newest state, so a
//! pattern subscriber misses intermediate matches but never ends up with a wrong set of them. Waking: a blocked
//! `recv` by a condition variable, anything else (an async task) by a callback, called after the commit's lock
//! is given back, from the committing thread; it must be quick.

use std::collections::{BTreeSet, VecDeque};
use std::num::NonZeroUsize;
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use crate::delta::Delta;
use crate::id::Version;
use crate::mentions::Mentions;
use crate::pattern::{Binding, Pattern};
use crate::snapshot::Snapshot;

/// How many commits a queue holds unless the subscriber says otherwise.
pub(crate) const CAPACITY: NonZeroUsize = NonZeroUsize::new(1024).expect("not zero");

type Waker = Arc<dyn Fn() + Send + Sync>;

/// A commit, as subscribers get it.
#[derive(Debug, Clone)]
pub struct Committed {
    /// What changed.
    pub delta: Arc<Delta>,
    /// The state that it led to.
    pub snapshot: Snapshot,
}

/// What a subscription to all deltas gives.
#[derive(Debug, Clone)]
pub enum Event {
    /// The next commit.
    Committed(Committed),
    /// Commits were dropped because the queue was full; the next ones follow on this state.
    Lagged {
        /// How many commits were dropped, this one included.
        missed: u64,
        /// The state to resynchronise from.
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

/// The writers' end of one subscription.
pub(crate) struct Queue {
    content: Mutex<Content>,
    ready: Condvar,
    capacity: usize,
    /// Only commits that touch this; `None` for all.
    filter: Option<Mentions>,
}

#[derive(Default)]
struct Content {
    commits: VecDeque<Committed>,
    missed: u64,
    closed: bool,
    waker: Option<Waker>,
}

impl Queue {
    pub(crate) fn new(capacity: NonZeroUsize, filter: Option<Mentions>) -> Arc<Self> {
        Arc::new(Self { content: Mutex::default(), ready: Condvar::new(), capacity: capacity.get(), filter })
    }

    /// Takes note of a commit, if it concerns the subscriber; gives the callback to call later.
    pub(crate) fn push(&self, committed: &Committed, touched: &Mentions) -> Option<Waker> {
        if self.filter.as_ref().is_some_and(|filter| !filter.intersects(touched)) {
            return None;
        }
        let mut content = self.content();
        if content.commits.len() >= self.capacity {
            content.missed += content.commits.len() as u64;
            content.commits.clear();
        }
        content.commits.push_back(committed.clone());
        self.ready.notify_all();
        content.waker.clone()
    }

    pub(crate) fn close(&self) -> Option<Waker> {
        let mut content = self.content();
        content.closed = true;
        self.ready.notify_all();
        content.waker.clone()
    }

    fn content(&self) -> std::sync::MutexGuard<'_, Content> {
        // No code of others runs under this lock, so a poisoned one still holds a whole queue.
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn pop(content: &mut Content) -> Option<Event> {
        let committed = content.commits.pop_front()?;
        let missed = std::mem::take(&mut content.missed);
        if missed == 0 {
            return Some(Event::Committed(committed));
        }
        Some(Event::Lagged { missed: missed + 1, snapshot: committed.snapshot })
    }

    fn try_recv(&self) -> Option<Event> {
        Self::pop(&mut self.content())
    }

    fn recv(&self) -> Option<Event> {
        let mut content = self.content();
        loop {
            if let Some(event) = Self::pop(&mut content) {
                return Some(event);
            }
            if content.closed {
                return None;
            }
            content = self.ready.wait(content).unwrap_or_else(PoisonError::into_inner);
        }
    }

    fn on_wake(&self, waker: &Waker) {
        let pending = {
            let mut content = self.content();
            content.waker = Some(Arc::clone(waker));
            !content.commits.is_empty() || content.closed
        };
        if pending {
            waker();
        }
    }

    fn is_closed(&self) -> bool {
        let content = self.content();
        content.closed && content.commits.is_empty()
    }
}

/// Every commit from the one after [`Deltas::start`] on.
pub struct Deltas {
    pub(crate) queue: Arc<Queue>,
    pub(crate) start: Snapshot,
}

impl Deltas {
    /// The state on which the first event follows.
    pub fn start(&self) -> &Snapshot {
        &self.start
    }

    /// The next event, if there is one.
    pub fn try_recv(&self) -> Option<Event> {
        self.queue.try_recv()
    }

    /// Waits for the next event; `None` when all handles of the graph are gone.
    pub fn recv(&self) -> Option<Event> {
        self.queue.recv()
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether nothing will ever come again.
    pub fn is_closed(&self) -> bool {
        self.queue.is_closed()
    }
}

/// How the matches of a pattern changed.
#[derive(Debug, Clone)]
pub struct MatchChange {
    /// The version in which they did.
    pub version: Version,
    /// Matches that were not there before, in order.
    pub appeared: Vec<Binding>,
    /// Matches that are no longer there, in order.
    pub disappeared: Vec<Binding>,
    /// The state of that version.
    pub snapshot: Snapshot,
    /// How many commits were not looked at, because the queue was full.
    pub missed: u64,
}

/// The matches of a pattern, as they change. The first change has everything that matched at the start.
pub struct Matches {
    queue: Arc<Queue>,
    pattern: Arc<Pattern>,
    held: BTreeSet<Binding>,
    start: Option<Snapshot>,
}

impl Matches {
    pub(crate) fn new(queue: Arc<Queue>, pattern: Arc<Pattern>, start: Snapshot) -> Self {
        Self { queue, pattern, held: BTreeSet::new(), start: Some(start) }
    }

    /// The pattern.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// The matches after the changes received so far.
    pub fn held(&self) -> &BTreeSet<Binding> {
        &self.held
    }

    /// The next change, if there is one. Commits that change no match are passed over.
    pub fn try_recv(&mut self) -> Option<MatchChange> {
        loop {
            let (snapshot, missed) = match self.start.take() {
                Some(start) => (start, 0),
                None => content_of(self.queue.try_recv()?),
            };
            if let Some(change) = self.look(snapshot, missed) {
                return Some(change);
            }
        }
    }

    /// Waits for the next change; `None` when all handles of the graph are gone.
    pub fn recv(&mut self) -> Option<MatchChange> {
        loop {
            let (snapshot, missed) = match self.start.take() {
                Some(start) => (start, 0),
                None => content_of(self.queue.recv()?),
            };
            if let Some(change) = self.look(snapshot, missed) {
                return Some(change);
            }
        }
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        if self.start.is_some() {
            wake();
        }
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether nothing will ever come again.
    pub fn is_closed(&self) -> bool {
        self.start.is_none() && self.queue.is_closed()
    }

    fn look(&mut self, snapshot: Snapshot, missed: u64) -> Option<MatchChange> {
        let now: BTreeSet<_> = self.pattern.matches(&snapshot).into_iter().collect();
        let appeared: Vec<_> = now.difference(&self.held).cloned().collect();
        let disappeared: Vec<_> = self.held.difference(&now).cloned().collect();
        self.held = now;
        if appeared.is_empty() && disappeared.is_empty() && missed == 0 {
            return None;
        }
        Some(MatchChange { version: snapshot.version(), appeared, disappeared, snapshot, missed })
    }
}

fn content_of(event: Event) -> (Snapshot, u64) {
    match event {
        Event::Committed(committed) => (committed.snapshot, 0),
        Event::Lagged { missed, snapshot } => (snapshot, missed),
    }
}

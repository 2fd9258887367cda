//! The queue between commits and one subscriber.

use std::collections::VecDeque;
use std::num::NonZeroUsize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::{Arc, Condvar, Mutex, PoisonError};

use smallvec::SmallVec;

use crate::delta::Delta;
use crate::snapshot::Snapshot;

/// The default capacity of a queue, in commits.
pub(crate) const CAPACITY: NonZeroUsize = NonZeroUsize::new(1024).expect("not zero");

pub(super) type Waker = Arc<dyn Fn() + Send + Sync>;

/// A commit, as subscribers receive it.
#[derive(Debug, Clone)]
pub struct Committed {
    /// What changed.
    pub delta: Arc<Delta>,
    /// The state after it.
    pub snapshot: Snapshot,
}

/// How a subscriber receives the commits since its last read.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Delivery {
    /// One by one, in order.
    #[default]
    Each,
    /// All of them as one. A match that appeared and disappeared in between is not reported. For subscribers that act
    /// on the present state, not on its history. Only the newest state is kept.
    Newest,
}

/// The settings of a subscription's queue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mailbox {
    /// The most commits that it holds. Beyond, the subscriber continues from the newest state.
    pub capacity: NonZeroUsize,
    /// How the subscriber receives commits.
    pub delivery: Delivery,
}

impl Default for Mailbox {
    fn default() -> Self {
        Self { capacity: CAPACITY, delivery: Delivery::Each }
    }
}

impl From<NonZeroUsize> for Mailbox {
    fn from(capacity: NonZeroUsize) -> Self {
        Self { capacity, ..Self::default() }
    }
}

impl From<Delivery> for Mailbox {
    fn from(delivery: Delivery) -> Self {
        Self { delivery, ..Self::default() }
    }
}

/// The writers' end of one subscription.
pub(crate) struct Queue {
    content: Mutex<Content>,
    ready: Condvar,
    mailbox: Mailbox,
}

#[derive(Default)]
struct Content {
    /// Each with the state after it; with [`Delivery::Newest`], only the last one has a state.
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    /// The state before the first commit, until it is read or missed.
    start: Option<Snapshot>,
    missed: u64,
    closed: bool,
    /// The number of threads that wait in `recv`.
    asleep: u32,
    waker: Option<Waker>,
}

/// The old content of a queue, to be freed after the locks are released.
#[derive(Default)]
struct Freed {
    commits: VecDeque<(Arc<Delta>, Option<Snapshot>)>,
    start: Option<Snapshot>,
}

/// What remains to be done for a queue after the locks are released.
pub(crate) struct Wake {
    sleeper: Option<Arc<Queue>>,
    waker: Option<Waker>,
    _freed: Freed,
}

impl Wake {
    /// Wakes the subscriber. The panic of a callback does not reach the committer.
    pub(crate) fn call(self) {
        if let Some(queue) = &self.sleeper {
            queue.ready.notify_all();
        }
        if let Some(waker) = &self.waker {
            let _ = catch_unwind(AssertUnwindSafe(|| waker()));
        }
    }
}

/// What a queue returns.
pub(super) enum Told {
    /// These commits led to this state.
    Commits(SmallVec<[Arc<Delta>; 1]>, Snapshot),
    Lagged {
        missed: u64,
        snapshot: Snapshot,
    },
}

impl Queue {
    pub(crate) fn new(mailbox: Mailbox) -> Arc<Self> {
        Arc::new(Self { content: Mutex::default(), ready: Condvar::new(), mailbox })
    }

    /// Sets the first state. Called under the commit lock, before the first commit is pushed.
    pub(crate) fn begin(&self, start: Snapshot) {
        self.content().start = Some(start);
    }

    pub(super) fn start(&self) -> Option<Snapshot> {
        self.content().start.clone()
    }

    pub(super) fn take_start(&self) -> Option<Snapshot> {
        self.content().start.take()
    }

    /// Adds a commit. Returns what remains to be done after the locks are released.
    pub(crate) fn push(self: &Arc<Self>, committed: &Committed) -> Option<Wake> {
        let mut content = self.content();
        let mut freed = Freed::default();
        // A subscriber to the newest state that has not read the first one yet begins with this one instead.
        if self.mailbox.delivery == Delivery::Newest && content.start.is_some() {
            freed.start = content.start.replace(committed.snapshot.clone());
            return self.wake(&content, freed);
        }
        if content.missed > 0 || content.commits.len() >= self.mailbox.capacity.get() {
            content.missed += content.commits.len() as u64;
            freed = Freed { commits: std::mem::take(&mut content.commits), start: content.start.take() };
        } else if self.mailbox.delivery == Delivery::Newest
            && let Some((delta, before)) = content.commits.back_mut()
        {
            freed.commits.push_back((Arc::clone(delta), before.take()));
        }
        content.commits.push_back((Arc::clone(&committed.delta), Some(committed.snapshot.clone())));
        self.wake(&content, freed)
    }

    pub(crate) fn close(self: &Arc<Self>) -> Option<Wake> {
        let mut content = self.content();
        content.closed = true;
        self.wake(&content, Freed::default())
    }

    fn wake(self: &Arc<Self>, content: &Content, freed: Freed) -> Option<Wake> {
        let sleeper = (content.asleep > 0).then(|| Arc::clone(self));
        let waker = content.waker.clone();
        let nothing =
            sleeper.is_none() && waker.is_none() && freed.commits.is_empty() && freed.start.is_none();
        (!nothing).then_some(Wake { sleeper, waker, _freed: freed })
    }

    fn content(&self) -> std::sync::MutexGuard<'_, Content> {
        // No callback runs under this lock, so a poisoned lock still guards a consistent queue.
        self.content.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next item; and the first state, which is no longer needed, to be freed after the lock is released.
    fn pop(content: &mut Content) -> Option<(Told, Option<Snapshot>)> {
        if content.commits.is_empty() {
            return None;
        }
        let start = content.start.take();
        Self::next(content).map(|told| (told, start))
    }

    fn next(content: &mut Content) -> Option<Told> {
        let missed = std::mem::take(&mut content.missed);
        let mut deltas = SmallVec::new();
        // Commits without a state are delivered together with the next one that has a state.
        while let Some((delta, snapshot)) = content.commits.pop_front() {
            deltas.push(delta);
            if let Some(snapshot) = snapshot {
                return Some(if missed == 0 {
                    Told::Commits(deltas, snapshot)
                } else {
                    Told::Lagged { missed: missed + 1, snapshot }
                });
            }
        }
        None
    }

    pub(super) fn try_recv(&self) -> Option<Told> {
        let popped = Self::pop(&mut self.content());
        popped.map(|(told, _)| told)
    }

    pub(super) fn recv(&self) -> Option<Told> {
        let mut content = self.content();
        loop {
            if let Some((told, start)) = Self::pop(&mut content) {
                drop(content);
                drop(start);
                return Some(told);
            }
            if content.closed {
                return None;
            }
            content.asleep += 1;
            content = self.ready.wait(content).unwrap_or_else(PoisonError::into_inner);
            content.asleep -= 1;
        }
    }

    pub(super) fn on_wake(&self, waker: &Waker) {
        let (pending, before) = {
            let mut content = self.content();
            let before = content.waker.replace(Arc::clone(waker));
            let pending = !content.commits.is_empty() || content.closed;
            (pending, before)
        };
        // Dropping a callback may commit, so no lock is held here.
        drop(before);
        if pending {
            waker();
        }
    }

    pub(super) fn is_closed(&self) -> bool {
        let content = self.content();
        content.closed && content.commits.is_empty()
    }
}

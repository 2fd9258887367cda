//! Subscriptions to an interest: after each commit that concerns it, what changed in that part of the graph.

use std::collections::BTreeSet;
use std::sync::Arc;

use smallvec::SmallVec;

use super::queue::{Queue, Told, Waker};
use super::tracker::{Difference, Tracker};
use crate::delta::Delta;
use crate::interest::{Interest, PatternId};
use crate::pattern::Binding;
use crate::snapshot::Snapshot;

/// How the matches of one pattern of an interest changed.
#[derive(Debug, Clone)]
pub struct Changed {
    /// Which pattern.
    pub pattern: PatternId,
    /// Matches that were not there before, in order.
    pub appeared: Vec<Binding>,
    /// Matches that are no longer there, in order.
    pub disappeared: Vec<Binding>,
}

/// What a subscription reports: a state, and how it differs from the one before in what the subscriber asked for.
#[derive(Debug, Clone)]
pub struct News {
    /// The state.
    pub snapshot: Snapshot,
    /// The commits that led to it and concern the subscriber: one, or several with [`Delivery::Newest`](super::Delivery::Newest). None at the
    /// start and after commits were missed: then the state has to be read as a whole.
    pub deltas: Vec<Arc<Delta>>,
    /// The patterns whose matches changed, in the order of the interest. At the start, everything that matches.
    pub matches: Vec<Changed>,
    /// How many commits were not looked at, because the queue was full.
    pub missed: u64,
}

/// The part of the graph that an [`Interest`] asks for, as it changes. The first news is the state of the start.
pub struct Subscription {
    queue: Arc<Queue>,
    interest: Arc<Interest>,
    pub(super) trackers: Vec<Tracker>,
    /// Whether anything was looked at yet.
    begun: bool,
}

impl Subscription {
    pub(crate) fn new(queue: Arc<Queue>, interest: Arc<Interest>) -> Self {
        let trackers = interest.patterns().map(|pattern| Tracker::new(Arc::clone(pattern))).collect();
        Self { queue, interest, trackers, begun: false }
    }

    /// The matches of a pattern after the news received so far.
    ///
    /// # Panics
    /// If the pattern is another interest's.
    pub fn held(&self, pattern: PatternId) -> &BTreeSet<Binding> {
        self.trackers[pattern.index()].held()
    }

    /// The next news, if there is any. Skips commits that do not concern the subscription.
    pub fn try_recv(&mut self) -> Option<News> {
        loop {
            let told = match self.begin() {
                Some(told) => told,
                None => self.queue.try_recv()?,
            };
            if let Some(news) = self.look(told) {
                return Some(news);
            }
        }
    }

    /// Waits for the next news; `None` when all handles of the graph are gone.
    pub fn recv(&mut self) -> Option<News> {
        loop {
            let told = match self.begin() {
                Some(told) => told,
                None => self.queue.recv()?,
            };
            if let Some(news) = self.look(told) {
                return Some(news);
            }
        }
    }

    /// Returns the first state, once; `None` if the queue has none.
    fn begin(&mut self) -> Option<Told> {
        if std::mem::replace(&mut self.begun, true) {
            return None;
        }
        self.queue.take_start().map(|snapshot| Told::Lagged { missed: 0, snapshot })
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        if !self.begun {
            wake();
        }
        self.queue.on_wake(&(Arc::new(wake) as Waker));
    }

    /// Whether no further news will come.
    pub fn is_closed(&self) -> bool {
        self.begun && self.queue.is_closed()
    }

    fn look(&mut self, told: Told) -> Option<News> {
        let (deltas, snapshot, missed) = match told {
            Told::Lagged { missed, snapshot } => (SmallVec::new(), snapshot, missed),
            Told::Commits(deltas, snapshot) => (deltas, snapshot, 0),
        };
        let mut matches = Vec::new();
        for (at, tracker) in self.trackers.iter_mut().enumerate() {
            let difference = if deltas.is_empty() {
                tracker.restart(&snapshot)
            } else {
                tracker.follow(&deltas, &snapshot)
            };
            if !difference.is_empty() {
                let Difference { appeared, disappeared } = difference;
                matches.push(Changed { pattern: PatternId::at(at), appeared, disappeared });
            }
        }
        let is_news = deltas.is_empty()
            || !matches.is_empty()
            || deltas.iter().any(|delta| self.interest.concerns(delta));
        is_news.then(|| News { snapshot, deltas: deltas.into_vec(), matches, missed })
    }
}

//! Subscriptions to the matches of one pattern.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::news::{News, Subscription};
use crate::id::Version;
use crate::pattern::{Binding, Pattern};
use crate::snapshot::Snapshot;

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

/// The matches of one pattern, as they change: a [`Subscription`] of that pattern alone. The first change has everything
/// that matched at the start.
pub struct Matches {
    subscription: Subscription,
}

impl Matches {
    pub(crate) fn new(subscription: Subscription) -> Self {
        Self { subscription }
    }

    /// The pattern.
    pub fn pattern(&self) -> &Arc<Pattern> {
        self.subscription.trackers[0].pattern()
    }

    /// The matches after the changes received so far.
    pub fn held(&self) -> &BTreeSet<Binding> {
        self.subscription.trackers[0].held()
    }

    /// The next change, if there is one. Commits that change no match are passed over.
    pub fn try_recv(&mut self) -> Option<MatchChange> {
        loop {
            if let Some(change) = change(self.subscription.try_recv()?) {
                return Some(change);
            }
        }
    }

    /// Waits for the next change; `None` when all handles of the graph are gone.
    pub fn recv(&mut self) -> Option<MatchChange> {
        loop {
            if let Some(change) = change(self.subscription.recv()?) {
                return Some(change);
            }
        }
    }

    /// Calls `wake` whenever there may be something to receive, and now if there is.
    pub fn on_wake(&self, wake: impl Fn() + Send + Sync + 'static) {
        self.subscription.on_wake(wake);
    }

    /// Whether nothing will ever come again.
    pub fn is_closed(&self) -> bool {
        self.subscription.is_closed()
    }
}

/// The news of one pattern; `None` for a start without matches.
fn change(News { snapshot, mut matches, missed, .. }: News) -> Option<MatchChange> {
    let (appeared, disappeared) =
        matches.pop().map_or_else(Default::default, |changed| (changed.appeared, changed.disappeared));
    if appeared.is_empty() && disappeared.is_empty() && missed == 0 {
        return None;
    }
    Some(MatchChange { version: snapshot.version(), appeared, disappeared, snapshot, missed })
}

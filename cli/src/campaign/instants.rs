//! The instants at which a campaign disturbs a run: each commit that changes something that PELEA or an agent sees.
//!
//! A run is the same up to its disruption, so the versions of the undisturbed run name the instants of all runs. Of
//! several commits at one time each is an instant of its own: what happens between two of them is where interleavings
//! differ. A recorded run on real devices has other versions than a simulated one; its instants are times.

use dsr::{
    Delta, Graph, Interest, Mailbox, Mentions, Played, Recording, RecordingError, Snapshot, Subscription,
};
use mission::scenario::Trigger;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;
use std::num::NonZeroUsize;
use std::path::Path;
use std::time::Duration;

/// More commits than a run has.
const COMMITS: NonZeroUsize = NonZeroUsize::new(1 << 20).expect("not zero");

/// An instant of the undisturbed run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Instant {
    /// The version of the graph then; 0 if the instant is a time.
    pub(super) version: u64,
    /// Seconds since the start.
    pub(super) time: f64,
    /// What the commit changed.
    pub(super) change: String,
}

impl Instant {
    /// The trigger of a disruption at this instant.
    pub(super) fn trigger(&self) -> Trigger {
        match self.version {
            0 => Trigger::At(Duration::from_secs_f64(self.time)),
            version => Trigger::Version(version),
        }
    }
}

impl fmt::Display for Instant {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.version {
            0 => write!(f, "at {:.3} s", self.time),
            version => write!(f, "after version {version} ({:.3} s)", self.time),
        }
    }
}

/// Watches the undisturbed run.
pub(super) struct Watcher(Vec<Subscription>);

impl Watcher {
    /// Watches a graph with the eyes of PELEA and the agents, from now on.
    pub(super) fn new(graph: &Graph, eyes: impl IntoIterator<Item = Interest>) -> Self {
        let mailbox = Mailbox { capacity: COMMITS, ..Mailbox::default() };
        Self(eyes.into_iter().map(|interest| graph.subscribe_to_with(interest, mailbox)).collect())
    }

    /// The instants until now.
    pub(super) fn instants(self) -> Vec<Instant> {
        let mut found = BTreeMap::new();
        for mut subscription in self.0 {
            while let Some(news) = subscription.try_recv() {
                for delta in &news.deltas {
                    found.entry(delta.version).or_insert_with(|| instant(delta, &news.snapshot));
                }
            }
        }
        found.into_values().collect()
    }
}

fn instant(delta: &Delta, after: &Snapshot) -> Instant {
    let change = delta.sentences(after).into_iter().next().unwrap_or_default();
    Instant { version: delta.version.0, time: Duration::from_nanos(delta.time.0).as_secs_f64(), change }
}

/// The instants of a recorded run, as times: the same tokens may change in other versions when it is simulated. A commit
/// that only moves something is none.
pub(super) fn recorded(folder: &Path) -> Result<Vec<Instant>, RecordingError> {
    let recording = Recording::open(folder)?;
    let mut found: Vec<Instant> = Vec::new();
    let mut replay = recording.replay()?;
    while let Some(played) = replay.next() {
        let Played::Commit(delta) = played? else { continue };
        let mentions = Mentions::of(&delta);
        let tokens = mentions.labels().next().is_some() || mentions.attributes().next().is_some();
        let instant = Instant { version: 0, ..instant(&delta, &replay.snapshot()) };
        if tokens && found.last().is_none_or(|last| last.time < instant.time) {
            found.push(instant);
        }
    }
    Ok(found)
}

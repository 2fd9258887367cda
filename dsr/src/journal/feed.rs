//! The feed: what commits hand to the journal's thread.
//!
//! Problem: a disk that stalls must slow no writer and fill no memory. Idea: a commit leaves a reference to its delta
//! and continues. When more deltas wait than the limit allows, further ones are dropped, and the thread begins again
//! with a whole state as soon as it can: the history then has a gap, but never a wrong state. Invariant: what was
//! accepted follows without gaps on what was handed out before; the deltas that wait and those that the thread holds
//! are together below the limit.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::delta::{Change, Delta};
use crate::id::{ReflexId, Version};
use crate::pose::{Covariance, Pose};
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::transaction::reflexes::{Guard, Registry};

/// A commit as a journal keeps it. One that only registers or dismisses reflexes has the version before it and an empty
/// delta.
#[derive(Debug, Clone)]
pub(crate) struct Entry {
    pub(crate) delta: Arc<Delta>,
    /// The reflexes that it registered and that have not fired in it.
    pub(crate) registered: Vec<Guard>,
    /// Those that it dismissed.
    pub(crate) dismissed: Vec<ReflexId>,
}

impl Entry {
    /// Whether there is nothing to keep of it.
    pub(crate) fn is_empty(&self) -> bool {
        self.is_silent() && self.registered.is_empty() && self.dismissed.is_empty()
    }

    /// Whether it made no version.
    pub(super) fn is_silent(&self) -> bool {
        self.delta.changes.is_empty() && self.delta.reflexes.is_empty()
    }
}

/// A whole state, and the reflexes that are registered in it.
#[derive(Debug, Clone)]
pub(crate) struct Present {
    pub(crate) snapshot: Snapshot,
    pub(crate) reflexes: Registry,
}

/// The queue between the commits and the thread.
#[derive(Debug)]
pub(crate) struct Feed {
    waiting: Mutex<Waiting>,
    /// Signals work to the thread.
    came: Condvar,
    /// Signals progress to callers that wait for a version.
    went: Condvar,
    /// The most bytes of deltas that may wait or be held by the thread.
    limit: usize,
}

#[derive(Debug, Default)]
struct Waiting {
    entries: Vec<Entry>,
    bytes: usize,
    /// The bytes of the last group handed out; the thread holds it until the disk has it, and then returns.
    held: usize,
    /// Commits are dropped until the thread has taken a state.
    overflowed: bool,
    /// The thread is waiting.
    asleep: bool,
    /// A caller waits for this version to be synced.
    wanted: Version,
    end: Option<End>,
    done: Progress,
}

/// Why no more commits will come.
#[derive(Debug, Clone)]
enum End {
    /// The graph was dropped; this was its last state.
    Graph(Present),
    /// The journal is closed, or has failed.
    Journal,
}

/// The progress of the thread.
#[derive(Debug, Clone, Default)]
pub(super) struct Progress {
    pub(super) written: Version,
    pub(super) durable: Version,
    pub(super) gaps: u64,
    pub(super) error: Option<Arc<std::io::Error>>,
    /// The thread has ended.
    pub(super) over: bool,
}

/// Work for the thread.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub(super) entries: Vec<Entry>,
    /// Commits were dropped: begin again with a whole state.
    pub(super) overflowed: bool,
    /// A caller waits for this version to be synced.
    pub(super) wanted: Version,
    pub(super) last: Option<Last>,
}

/// What was waiting when the thread began again.
#[derive(Debug)]
pub(crate) struct Rest {
    pub(super) entries: Vec<Entry>,
    /// Whether commits were dropped between these and the present state; this may have happened since the thread's last
    /// look.
    pub(super) overflowed: bool,
}

/// No more commits will come.
#[derive(Debug)]
pub(super) struct Last {
    /// The last state of a graph that was dropped.
    pub(super) state: Option<Present>,
}

/// The approximate size of a commit in memory, without texts.
fn size(Entry { delta, registered, dismissed }: &Entry) -> usize {
    let written: usize = registered.iter().map(|guard| size_of_val(&*guard.on_break)).sum();
    let covariances = delta.changes.iter().flat_map(poses).filter(|pose| pose.covariance.is_some()).count();
    size_of::<Entry>()
        + size_of::<Delta>()
        + size_of_val(&**registered)
        + size_of_val(&**dismissed)
        + written
        + size_of_val(&*delta.changes)
        + size_of_val(&*delta.reflexes)
        + covariances * size_of::<Covariance>()
}

/// The poses of a change.
fn poses(change: &Change) -> impl Iterator<Item = &Pose> {
    let (old, new) = match change {
        Change::TransformRemoved { old, .. } => (Some(old), None),
        Change::TransformAdded { new, .. } => (None, Some(new)),
        Change::TransformChanged { old, new, .. } => (Some(old), Some(new)),
        Change::TransformSampled { old, new, .. } => (old.as_ref(), Some(new)),
        Change::AttributeRemoved { .. }
        | Change::EdgeRemoved { .. }
        | Change::NodeRemoved { .. }
        | Change::NodeAdded { .. }
        | Change::EdgeAdded { .. }
        | Change::AttributeAdded { .. }
        | Change::AttributeChanged { .. } => (None, None),
    };
    old.into_iter().chain(new)
}

impl Feed {
    pub(super) fn new(limit: usize) -> Self {
        Self { waiting: Mutex::default(), came: Condvar::new(), went: Condvar::new(), limit }
    }

    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Accepts a commit. Called under the commit lock; false if the journal has ended.
    pub(crate) fn push(&self, entry: &Entry) -> bool {
        let mut waiting = self.lock();
        if waiting.end.is_some() {
            return false;
        }
        let bytes = waiting.bytes + size(entry);
        if waiting.overflowed || bytes.saturating_add(waiting.held) > self.limit {
            waiting.overflowed = true;
        } else {
            waiting.bytes = bytes;
            waiting.entries.push(entry.clone());
        }
        if std::mem::take(&mut waiting.asleep) {
            drop(waiting);
            self.came.notify_one();
        }
        true
    }

    /// Ends the feed because the graph is dropped.
    pub(crate) fn close(&self, state: &Arc<State>, reflexes: &Registry) {
        let mut waiting = self.lock();
        waiting.end.get_or_insert_with(|| {
            End::Graph(Present { snapshot: Snapshot::new(Arc::clone(state)), reflexes: reflexes.clone() })
        });
        self.came.notify_one();
    }

    /// Ends the feed because the journal has ended.
    pub(super) fn end(&self) {
        self.lock().end.get_or_insert(End::Journal);
        self.came.notify_one();
    }

    /// Waits for work, at most until `until`. The previous group counts as written.
    pub(super) fn take(&self, until: Option<Instant>, spare: Vec<Entry>) -> Work {
        let mut waiting = self.lock();
        waiting.held = 0;
        let idle = |w: &Waiting| {
            let wanted = w.wanted > w.done.durable && w.done.written > w.done.durable;
            w.entries.is_empty() && !w.overflowed && w.end.is_none() && !wanted
        };
        while idle(&waiting) {
            waiting.asleep = true;
            let left = until.map(|until| until.saturating_duration_since(Instant::now()));
            waiting = match left {
                Some(Duration::ZERO) => break,
                Some(left) => {
                    let waited = self.came.wait_timeout(waiting, left);
                    waited.unwrap_or_else(PoisonError::into_inner).0
                }
                None => self.came.wait(waiting).unwrap_or_else(PoisonError::into_inner),
            };
        }
        waiting.asleep = false;
        waiting.held = std::mem::take(&mut waiting.bytes);
        Work {
            entries: std::mem::replace(&mut waiting.entries, spare),
            overflowed: waiting.overflowed,
            wanted: waiting.wanted,
            last: waiting.end.as_ref().map(|end| Last {
                state: if let End::Graph(state) = end { Some(state.clone()) } else { None },
            }),
        }
    }

    /// Takes what is waiting; from here on commits are accepted again. Called under the commit lock.
    pub(crate) fn restart(&self) -> Rest {
        let mut waiting = self.lock();
        waiting.held = std::mem::take(&mut waiting.bytes);
        Rest {
            entries: std::mem::take(&mut waiting.entries),
            overflowed: std::mem::take(&mut waiting.overflowed),
        }
    }

    /// Reports the progress of the thread.
    pub(super) fn report(&self, progress: &Progress) {
        self.lock().done = progress.clone();
        self.went.notify_all();
    }

    pub(super) fn progress(&self) -> Progress {
        self.lock().done.clone()
    }

    /// Waits until a version is synced, or never will be.
    pub(super) fn wait(&self, version: Version) -> Progress {
        let mut waiting = self.lock();
        waiting.wanted = waiting.wanted.max(version);
        self.came.notify_one();
        while waiting.done.durable < version && !waiting.done.over {
            waiting = self.went.wait(waiting).unwrap_or_else(PoisonError::into_inner);
        }
        waiting.done.clone()
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that fails says where")]
mod tests {
    use nalgebra::{Isometry3, Matrix6};

    use super::*;
    use crate::graph::Graph;
    use crate::id::{AgentId, NodeId, Time};
    use crate::vocabulary::{Nature, VocabularyBuilder};

    #[test]
    fn what_the_thread_holds_is_counted_until_it_comes_again() {
        let mut builder = VocabularyBuilder::new();
        let thing = builder.node_type("thing", None, Nature::Symbolic).unwrap();
        let graph = Graph::new(builder.build());
        let mut names = 0..;
        let mut add = |commits| {
            for name in names.by_ref().take(commits) {
                let name = format!("thing {name}");
                graph.edit(AgentId::DSR, Time(0), |tx| _ = tx.add_node(name.as_str(), thing)).unwrap();
            }
        };
        // Room for four commits of one change.
        let feed = Arc::new(Feed::new(4 * (size_of::<Entry>() + size_of::<Delta>() + size_of::<Change>())));
        graph.attach(&feed);
        add(3);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.entries.len(), work.overflowed), (3, false));
        add(1);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.entries.len(), work.overflowed), (1, false));
        add(5);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.entries.len(), work.overflowed), (3, true));
        assert_eq!(feed.restart().entries.len(), 0);
        add(4);
        let rest = feed.restart();
        assert_eq!((rest.entries.len(), rest.overflowed), (4, false));
        add(1);
        assert!(feed.take(None, Vec::new()).overflowed);
    }

    #[test]
    fn covariances_are_counted() {
        let sampled = |covariance: Option<Covariance>| {
            let place = Isometry3::identity();
            let new = covariance.map_or(Pose::from(place), |covariance| Pose::new(place, covariance));
            let (parent, child, time) = (NodeId(0), NodeId(1), Time(1));
            let change = Change::TransformSampled { parent, child, time, old: Some(new.clone()), new };
            let (version, writer) = (Version(1), AgentId::DSR);
            let delta = Delta { version, time, writer, changes: vec![change], reflexes: Vec::new() };
            size(&Entry { delta: Arc::new(delta), registered: Vec::new(), dismissed: Vec::new() })
        };
        let covariance = Covariance::new(Matrix6::identity()).unwrap();
        assert_eq!(sampled(Some(covariance)), sampled(None) + 2 * size_of::<[f64; 36]>());
    }
}

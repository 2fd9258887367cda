//! The feed: what commits hand to the journal's thread.
//!
//! Problem: a disk that stalls must slow no writer and fill no memory. Idea: a commit leaves a reference to its delta
//! and goes on. When more wait than the limit allows, nothing more is taken in, and the thread begins anew with a whole
//! state as soon as it can: what is missing is a gap in the history, never a wrong state. Invariant: what was taken in
//! follows without gaps on what was handed out before, and what waits and what the thread holds stay below the limit
//! together.

use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::delta::{Change, Delta};
use crate::id::Version;
use crate::pose::{Covariance, Pose};
use crate::snapshot::Snapshot;
use crate::state::State;

/// Between the commits and the thread.
#[derive(Debug)]
pub(crate) struct Feed {
    waiting: Mutex<Waiting>,
    /// Something came for a thread that waits.
    came: Condvar,
    /// Something was written, for whoever waits for a version.
    went: Condvar,
    /// The most bytes of deltas that may wait or be in the thread's hands.
    limit: usize,
}

#[derive(Debug, Default)]
struct Waiting {
    deltas: Vec<Arc<Delta>>,
    bytes: usize,
    /// Bytes of what was handed out last: the thread holds it until the disk has taken it, and then comes again.
    held: usize,
    /// Commits are not taken in until the thread has taken a state.
    overflowed: bool,
    /// The thread sleeps.
    asleep: bool,
    /// Somebody waits for this version to be on the disk.
    wanted: Version,
    end: Option<End>,
    done: Progress,
}

/// Why nothing more will come.
#[derive(Debug, Clone)]
enum End {
    /// The graph is gone; this was its last state.
    Graph(Snapshot),
    /// The journal is closed, or has failed.
    Journal,
}

/// How far the thread has come.
#[derive(Debug, Clone, Default)]
pub(super) struct Progress {
    pub(super) written: Version,
    pub(super) durable: Version,
    pub(super) gaps: u64,
    pub(super) error: Option<Arc<std::io::Error>>,
    /// The thread has ended.
    pub(super) over: bool,
}

/// What the thread is handed.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub(super) deltas: Vec<Arc<Delta>>,
    /// Commits were lost: begin anew.
    pub(super) overflowed: bool,
    /// Somebody waits for this version to be on the disk.
    pub(super) wanted: Version,
    pub(super) last: Option<Last>,
}

/// What still waited when the thread began anew.
#[derive(Debug)]
pub(crate) struct Rest {
    pub(super) deltas: Vec<Arc<Delta>>,
    /// Commits were left out between these and the state of now. It may have come to that since the thread looked last.
    pub(super) overflowed: bool,
}

/// Nothing more will come.
#[derive(Debug)]
pub(super) struct Last {
    /// The last state of a graph that is gone.
    pub(super) state: Option<Snapshot>,
}

/// About what a delta takes in memory, texts left out.
fn size(delta: &Delta) -> usize {
    let covariances = delta.changes.iter().flat_map(poses).filter(|pose| pose.covariance.is_some()).count();
    size_of::<Delta>()
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

    /// Takes a commit in. Called under the commit lock; false if nobody will read it.
    pub(crate) fn push(&self, delta: &Arc<Delta>) -> bool {
        let mut waiting = self.lock();
        if waiting.end.is_some() {
            return false;
        }
        let bytes = waiting.bytes + size(delta);
        if waiting.overflowed || bytes.saturating_add(waiting.held) > self.limit {
            waiting.overflowed = true;
        } else {
            waiting.bytes = bytes;
            waiting.deltas.push(Arc::clone(delta));
        }
        if std::mem::take(&mut waiting.asleep) {
            drop(waiting);
            self.came.notify_one();
        }
        true
    }

    /// The graph is gone.
    pub(crate) fn close(&self, state: &Arc<State>) {
        let mut waiting = self.lock();
        waiting.end.get_or_insert_with(|| End::Graph(Snapshot::new(Arc::clone(state))));
        self.came.notify_one();
    }

    /// Nothing more is wanted.
    pub(super) fn end(&self) {
        self.lock().end.get_or_insert(End::Journal);
        self.came.notify_one();
    }

    /// Waits for something to do, at most until `until`. What was handed out before is gone.
    pub(super) fn take(&self, until: Option<Instant>, spare: Vec<Arc<Delta>>) -> Work {
        let mut waiting = self.lock();
        waiting.held = 0;
        let idle = |w: &Waiting| {
            let wanted = w.wanted > w.done.durable && w.done.written > w.done.durable;
            w.deltas.is_empty() && !w.overflowed && w.end.is_none() && !wanted
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
            deltas: std::mem::replace(&mut waiting.deltas, spare),
            overflowed: waiting.overflowed,
            wanted: waiting.wanted,
            last: waiting.end.as_ref().map(|end| Last {
                state: if let End::Graph(state) = end { Some(state.clone()) } else { None },
            }),
        }
    }

    /// What still waits; from here on everything is taken in again. Called under the commit lock.
    pub(crate) fn restart(&self) -> Rest {
        let mut waiting = self.lock();
        waiting.held = std::mem::take(&mut waiting.bytes);
        Rest {
            deltas: std::mem::take(&mut waiting.deltas),
            overflowed: std::mem::take(&mut waiting.overflowed),
        }
    }

    /// Says how far the thread is.
    pub(super) fn report(&self, progress: &Progress) {
        self.lock().done = progress.clone();
        self.went.notify_all();
    }

    pub(super) fn progress(&self) -> Progress {
        self.lock().done.clone()
    }

    /// Waits until a version is on the disk, or never will be.
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
        let feed = Arc::new(Feed::new(4 * (size_of::<Delta>() + size_of::<Change>())));
        graph.attach(&feed);
        add(3);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.deltas.len(), work.overflowed), (3, false));
        add(1);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.deltas.len(), work.overflowed), (1, false));
        add(5);
        let work = feed.take(None, Vec::new());
        assert_eq!((work.deltas.len(), work.overflowed), (3, true));
        assert_eq!(feed.restart().deltas.len(), 0);
        add(4);
        let rest = feed.restart();
        assert_eq!((rest.deltas.len(), rest.overflowed), (4, false));
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
            size(&Delta { version, time, writer, changes: vec![change], reflexes: Vec::new() })
        };
        let covariance = Covariance::new(Matrix6::identity()).unwrap();
        assert_eq!(sampled(Some(covariance)), sampled(None) + 2 * size_of::<[f64; 36]>());
    }
}

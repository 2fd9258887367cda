//! The last versions, in memory.
//!
//! Problem: "what was it a second ago" should not need a disk. Idea: a ring of snapshots, empty by default, because
//! each held snapshot makes commits copy. Invariant: the versions in it are consecutive, up to the present one.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::id::Version;
use crate::snapshot::Snapshot;

#[derive(Debug, Default)]
pub(crate) struct Past(Mutex<Ring>);

#[derive(Debug, Default)]
struct Ring {
    /// The number of versions to keep before the present one.
    count: usize,
    /// The oldest first, the present one last; empty if none is kept.
    versions: VecDeque<Snapshot>,
}

impl Past {
    fn lock(&self) -> MutexGuard<'_, Ring> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Sets the number of versions to keep. Called under the commit lock. Returns the snapshots that are dropped, for
    /// the caller to free without the lock.
    pub(crate) fn keep(&self, count: usize, present: &Snapshot) -> Vec<Snapshot> {
        let mut ring = self.lock();
        ring.count = count;
        if ring.versions.is_empty() {
            ring.versions.push_back(present.clone());
        }
        let kept = if count == 0 { 0 } else { count.saturating_add(1) };
        let surplus = ring.versions.len().saturating_sub(kept);
        ring.versions.drain(..surplus).collect()
    }

    /// Adds a new version. Called under the commit lock. Returns the snapshot that is dropped.
    pub(crate) fn push(&self, snapshot: &Snapshot) -> Option<Snapshot> {
        let mut ring = self.lock();
        if ring.count == 0 {
            return None;
        }
        ring.versions.push_back(snapshot.clone());
        if ring.versions.len() - 1 > ring.count { ring.versions.pop_front() } else { None }
    }

    pub(crate) fn at(&self, version: Version) -> Option<Snapshot> {
        let ring = self.lock();
        let first = ring.versions.front()?.version();
        let at = usize::try_from(version.0.checked_sub(first.0)?).ok()?;
        ring.versions.get(at).filter(|found| found.version() == version).cloned()
    }
}

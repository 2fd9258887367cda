//! The input of one search, and the data that the searches of one query share.

use super::landmarks::LandmarkGraph;
use crate::query::{Barred, SearchMeter};
use crate::task::{Goal, Relaxation, State, Task};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// The input of one search.
#[derive(Clone, Copy)]
pub(crate) struct Job<'a> {
    pub(crate) task: &'a Task,
    pub(crate) state: &'a State,
    pub(crate) goal: &'a Goal,
    pub(crate) barred: &'a Barred,
    pub(crate) meter: &'a SearchMeter<'a>,
    pub(crate) bound: &'a Bound,
    pub(crate) shared: &'a Shared,
}

/// Data that the first search computes when needed, for all searches of the query.
#[derive(Default)]
pub(crate) struct Shared {
    landmarks: OnceLock<LandmarkGraph>,
}

impl<'a> Job<'a> {
    /// The landmarks of the query. They are incomplete if the meter is stopped; the search then
    /// ends.
    pub(crate) fn landmarks(&self) -> &'a LandmarkGraph {
        let graph = self.relaxation();
        let of = || LandmarkGraph::of(self.task, graph, (self.state, self.goal), self.barred, self.meter);
        self.shared.landmarks.get_or_init(of)
    }

    /// The relaxation for heuristics that never count an operator twice for two effects.
    pub(crate) fn relaxation(&self) -> &'a Relaxation {
        // An operator that dominates others may be barred.
        if self.barred.is_empty() { &self.task.undominated } else { &self.task.relaxation }
    }
}

/// Plans must cost less than this. Several searches lower it; none raises it.
#[derive(Debug)]
pub(crate) struct Bound(AtomicU64);

impl Bound {
    pub(crate) fn none() -> Self {
        Self(AtomicU64::new(u64::MAX))
    }

    pub(crate) fn get(&self) -> u64 {
        self.0.load(Relaxed)
    }

    pub(crate) fn lower(&self, to: u64) {
        self.0.fetch_min(to, Relaxed);
    }
}

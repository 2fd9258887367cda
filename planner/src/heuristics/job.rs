//! One search's share of a question: what it needs to know, and the bound that searches share.

use super::landmarks::LandmarkGraph;
use crate::query::{Barred, SearchMeter};
use crate::task::{Goal, Relaxation, State, Task};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

/// What a search works on.
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

/// What the first search that needs it finds out for all searches on one question.
#[derive(Default)]
pub(crate) struct Shared {
    landmarks: OnceLock<LandmarkGraph>,
}

impl<'a> Job<'a> {
    /// The landmarks of the question. Incomplete where the meter is stopped, and then the search ends.
    pub(crate) fn landmarks(&self) -> &'a LandmarkGraph {
        let graph = self.relaxation();
        let of = || LandmarkGraph::of(self.task, graph, (self.state, self.goal), self.barred, self.meter);
        self.shared.landmarks.get_or_init(of)
    }

    /// The relaxation for estimates that never count an operator twice for two ends.
    pub(crate) fn relaxation(&self) -> &'a Relaxation {
        // What dominates may be barred.
        if self.barred.is_empty() { &self.task.undominated } else { &self.task.relaxation }
    }
}

/// Plans must cost less than this. Several searches lower it, and none raises it.
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

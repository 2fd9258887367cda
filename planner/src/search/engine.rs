//! The search algorithms with their parameters.

use super::bfws::{Bfws, BfwsSettings};
use super::dual_bfws::{BackEnd, DualBfws};
use super::eager::{Eager, EagerSettings};
use super::hill_climbing::HillClimbing;
use super::improving::Improving;
use super::lazy::{Lazy, LazySettings};
use super::measured::Measured;
use super::searcher::Searcher;
use crate::heuristics::Job;

/// A search algorithm with its parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Engine {
    /// Best-first with deferred evaluation and preferred operators.
    Lazy(LazySettings),
    /// Best-first search that estimates states when they are generated: A* and its variants.
    Eager(EagerSettings),
    /// Enforced hill-climbing on relaxed plans.
    HillClimbing,
    /// Best-first width search.
    Bfws(BfwsSettings),
    /// A width search that drops states without novelty, then a complete one with better estimates.
    DualBfws,
    /// The second part of [`Self::DualBfws`] alone.
    BackEnd,
    /// Searches for better and better plans below a bound.
    Improving,
    /// Searches for paths with a better metric value, if the metric is not a sum of costs.
    Measured,
}

impl Engine {
    /// The work that the other members of a portfolio do before this one joins. An engine that
    /// estimates every state is for tasks on which the others fail; small tasks should not wait for
    /// it.
    pub(crate) fn joins_after(self) -> u64 {
        match self {
            Self::BackEnd => 1 << 32,
            _ => 0,
        }
    }

    pub(crate) fn start<'a>(self, job: Job<'a>) -> Box<dyn Searcher + Send + 'a> {
        match self {
            Self::Lazy(settings) => Box::new(Lazy::new(job, &settings)),
            Self::Eager(settings) => Box::new(Eager::new(job, &settings)),
            Self::HillClimbing => Box::new(HillClimbing::new(job)),
            Self::Bfws(settings) => Box::new(Bfws::new(job, settings)),
            Self::DualBfws => Box::new(DualBfws::new(job)),
            Self::BackEnd => Box::new(BackEnd::new(job)),
            Self::Improving => Box::new(Improving::new(job)),
            Self::Measured => Box::new(Measured::new(job)),
        }
    }
}

//! A search that can be interrupted and resumed.

use super::{Outcome, Statistics, Turn};
use crate::heuristics::Job;
use crate::query::Signal;

/// A running search. It owns its states and open lists.
pub(crate) trait Searcher {
    /// Continues until there is an answer or a limit, or the turn ends; `None` if the turn ends.
    fn advance(&mut self, turn: &Turn) -> Option<Outcome>;

    /// The statistics so far.
    fn statistics(&self) -> Statistics;
}

/// A search that advances in small steps.
pub(crate) trait Stepwise {
    /// The job of the search.
    fn job(&self) -> &Job<'_>;

    /// The bytes that it holds.
    fn memory(&self) -> usize;

    /// The statistics so far.
    fn statistics(&self) -> Statistics;

    /// Advances by one step; the first call begins the search.
    fn next(&mut self) -> Option<Outcome>;
}

impl<S: Stepwise> Searcher for S {
    fn advance(&mut self, turn: &Turn) -> Option<Outcome> {
        loop {
            match self.job().meter.signal(turn, Stepwise::statistics(self).expanded, self.memory()) {
                Signal::Go => {}
                Signal::Pause => return None,
                Signal::Stop(limit) => return Some(Outcome::LimitReached(limit)),
            }
            if let Some(answer) = self.next() {
                return Some(answer);
            }
        }
    }

    fn statistics(&self) -> Statistics {
        Stepwise::statistics(self)
    }
}

//! A search that can be interrupted and resumed.

use super::{Outcome, Statistics, Turn};
use crate::heuristics::Job;
use crate::query::Signal;

/// A running search. It owns its states and open lists.
pub(crate) trait Searcher {
    /// Goes on until there is an answer, a limit or the end of the turn; `None` is the last.
    fn advance(&mut self, turn: &Turn) -> Option<Outcome>;

    /// What it did so far.
    fn statistics(&self) -> Statistics;
}

/// A search that goes in small steps.
pub(crate) trait Stepwise {
    /// What it was asked to do.
    fn job(&self) -> &Job<'_>;

    /// Bytes that it holds.
    fn memory(&self) -> usize;

    /// What it did so far.
    fn statistics(&self) -> Statistics;

    /// Goes on a little; the first time, it begins.
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

//! A search that can be interrupted and resumed.

use super::{Outcome, Statistics, Turn};

/// A running search. It owns its states and open lists.
pub(crate) trait Searcher {
    /// Goes on until there is an answer, a limit or the end of the turn; `None` is the last.
    fn advance(&mut self, turn: &Turn) -> Option<Outcome>;

    /// What it did so far.
    fn statistics(&self) -> Statistics;
}

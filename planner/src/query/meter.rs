//! Counts the work of one search, and tells it when to stop or pause.
//!
//! Problem: a search must end within milliseconds of a cancellation, even inside one large estimate
//! or while its landmarks are computed. A portfolio must also assign turns without a clock, so that
//! the same call gives the same answer. Idea: every loop [spends](SearchMeter::spend) units of
//! work, about a nanosecond each; a turn is a number of units. Expanded states and bytes are
//! compared with the turn's limits between two steps of the search. Invariant: once stopped, a
//! meter stays stopped, and the search discards every estimate that it computed after that.

use budget::{Budget, Meter};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// The limit that ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The caller cancelled it.
    Interrupted,
    /// It expanded the allowed number of states.
    Expansions,
    /// Its states and open lists hold the allowed number of bytes.
    Memory,
    /// An incomplete search gave up without an answer.
    Incomplete,
}

/// The bytes for a search without a memory limit.
pub(crate) const UNLIMITED: usize = usize::MAX / 8;

/// The work to build, look up and store a state: some cache misses, then its words.
pub(crate) fn price_of_state(words: usize) -> usize {
    256 + words * 16
}

/// The meter of one search. Only one thread writes at a time.
#[derive(Debug)]
pub(crate) struct SearchMeter<'a> {
    budget: Budget<'a>,
    meter: Meter<'a>,
    /// The bytes that the search held when it last reported them.
    held: AtomicUsize,
}

/// The limits of one turn of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// The search pauses when its meter shows this much work.
    pub(crate) until: u64,
    /// The bytes that it may hold.
    pub(crate) bytes: usize,
    /// The states that it may expand in total.
    pub(crate) expansions: u64,
}

/// Whether the search continues, pauses or stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signal {
    Go,
    Pause,
    Stop(Limit),
}

impl<'a> SearchMeter<'a> {
    pub(crate) fn new(budget: Budget<'a>) -> Self {
        // The work limit of the budget is a number of expanded states; `signal` checks it.
        let meter = Meter::new(Budget { work: None, ..budget });
        Self { budget, meter, held: AtomicUsize::new(0) }
    }

    /// Adds work. Returns whether the search must stop.
    #[inline]
    pub(crate) fn spend(&self, units: usize) -> bool {
        self.meter.spend(units).is_err()
    }

    /// The meter of work alone, for functions that grounding calls too.
    pub(crate) fn meter(&self) -> &Meter<'a> {
        &self.meter
    }

    /// Whether the last results may be incomplete.
    pub(crate) fn is_stopped(&self) -> bool {
        self.meter.interruption().is_some()
    }

    pub(crate) fn work(&self) -> u64 {
        self.meter.work()
    }

    pub(crate) fn held(&self) -> usize {
        self.held.load(Relaxed)
    }

    /// Reports that the search has ended and holds nothing.
    pub(crate) fn release(&self) {
        self.held.store(0, Relaxed);
    }

    /// The whole budget as one turn.
    pub(crate) fn whole(&self) -> Turn {
        Turn {
            until: u64::MAX,
            bytes: self.budget.memory_bytes.unwrap_or(UNLIMITED),
            expansions: self.budget.work.unwrap_or(u64::MAX),
        }
    }

    /// Whether a search continues that has expanded this many states and holds this many bytes.
    pub(crate) fn signal(&self, turn: &Turn, expanded: u64, bytes: usize) -> Signal {
        self.held.store(bytes, Relaxed);
        if self.is_stopped() {
            Signal::Stop(Limit::Interrupted)
        } else if expanded >= turn.expansions {
            Signal::Stop(Limit::Expansions)
        } else if bytes >= turn.bytes {
            Signal::Stop(Limit::Memory)
        } else if self.work() >= turn.until {
            Signal::Pause
        } else {
            Signal::Go
        }
    }
}

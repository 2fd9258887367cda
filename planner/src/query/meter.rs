//! What one search has used up, and when it has to stop or pause.
//!
//! Problem: a search must end within milliseconds of a cancellation, also in the middle of one large
//! estimate or while its landmarks are being found, and a portfolio must deal out turns without a
//! clock, so that the same call gives the same answer. Idea: every loop [spends](SearchMeter::spend) units of
//! work, about a nanosecond each; a turn is a number of units. Expanded states and bytes are compared with
//! the turn between two steps of the search. Invariant: once stopped, a meter stays stopped, and the search
//! discards every estimate that it computed after that.

use budget::{Budget, Meter};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Which limit ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The caller cancelled it.
    Interrupted,
    /// It expanded as many states as allowed.
    Expansions,
    /// States and open lists hold as many bytes as allowed.
    Memory,
    /// An incomplete search gave up without an answer.
    Incomplete,
}

/// Bytes for a search without a limit.
pub(crate) const UNLIMITED: usize = usize::MAX / 8;

/// Work of building a state, looking it up and storing it: some misses of the cache, then its words.
pub(crate) fn price_of_state(words: usize) -> usize {
    256 + words * 16
}

/// Counts for one search. Only one thread at a time writes.
#[derive(Debug)]
pub(crate) struct SearchMeter<'a> {
    budget: Budget<'a>,
    meter: Meter<'a>,
    /// Bytes that the search held when it last reported them.
    held: AtomicUsize,
}

/// A turn of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// The search pauses when its meter shows so much work.
    pub(crate) until: u64,
    /// The bytes that it may hold.
    pub(crate) bytes: usize,
    /// The states that it may expand in all.
    pub(crate) expansions: u64,
}

/// Whether to go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Signal {
    Go,
    Pause,
    Stop(Limit),
}

impl<'a> SearchMeter<'a> {
    pub(crate) fn new(budget: Budget<'a>) -> Self {
        // The budget's work is a number of expanded states, which `signal` compares.
        let meter = Meter::new(Budget { work: None, ..budget });
        Self { budget, meter, held: AtomicUsize::new(0) }
    }

    /// Adds work. Answers whether the caller of the search wants it to stop.
    #[inline]
    pub(crate) fn spend(&self, units: usize) -> bool {
        self.meter.spend(units).is_err()
    }

    /// Counts the work, for functions that grounding calls too.
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

    /// The search ended and holds nothing.
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

    /// Whether a search goes on that has expanded so many states and holds so many bytes.
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

//! What one search has used up, and when it has to stop or pause.
//!
//! Problem: a search must end within milliseconds of an interruption, also in the middle of one large
//! estimate or while its landmarks are being found, and a portfolio must deal out turns without a
//! clock, so that the same call gives the same answer. Idea: whatever loops [`Meter::spend`]s units of
//! work, about a nanosecond each; the caller's closure is asked every so many units, and a turn is a
//! number of units. Invariant: once stopped, a meter stays stopped, and no estimate made after that is
//! believed.

use super::{Budget, Limit};
use crate::watch::{INTERVAL, Interrupted, Spend};
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering::Relaxed};

/// Bytes for whom nobody sets a limit.
pub(crate) const UNLIMITED: usize = usize::MAX / 8;

/// Work of building a state, looking it up and storing it: some misses of the cache, then its words.
pub(crate) fn price_of_state(words: usize) -> usize {
    256 + words * 16
}

/// Counts for one search. Only one thread writes at a time.
#[derive(Debug)]
pub(crate) struct Meter<'a> {
    budget: Budget<'a>,
    work: AtomicU64,
    next_question: AtomicU64,
    stopped: AtomicBool,
    /// Bytes that the search held when it was last asked.
    held: AtomicUsize,
}

/// A turn of a search.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    /// It pauses when its meter shows so much work.
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

impl Spend for Meter<'_> {
    fn try_spend(&self, units: usize) -> Result<(), Interrupted> {
        if self.spend(units) { Err(Interrupted) } else { Ok(()) }
    }
}

impl<'a> Meter<'a> {
    pub(crate) fn new(budget: Budget<'a>) -> Self {
        Self {
            budget,
            work: AtomicU64::new(0),
            next_question: AtomicU64::new(0),
            stopped: AtomicBool::new(false),
            held: AtomicUsize::new(0),
        }
    }

    /// Adds work. Answers whether the caller of the search wants it to stop.
    pub(crate) fn spend(&self, units: usize) -> bool {
        let work = self.work.load(Relaxed) + units as u64;
        self.work.store(work, Relaxed);
        if work >= self.next_question.load(Relaxed) {
            self.next_question.store(work + INTERVAL as u64, Relaxed);
            if (self.budget.interrupted)() {
                self.stopped.store(true, Relaxed);
            }
        }
        self.is_stopped()
    }

    /// Whether what was computed last may be incomplete.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Relaxed)
    }

    pub(crate) fn work(&self) -> u64 {
        self.work.load(Relaxed)
    }

    pub(crate) fn held(&self) -> usize {
        self.held.load(Relaxed)
    }

    /// The search is no more.
    pub(crate) fn release(&self) {
        self.held.store(0, Relaxed);
    }

    /// Where the whole budget is one turn.
    pub(crate) fn whole(&self) -> Turn {
        Turn {
            until: u64::MAX,
            bytes: self.budget.memory_bytes.unwrap_or(UNLIMITED),
            expansions: self.budget.expansions.unwrap_or(u64::MAX),
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

//! How many bytes grounding holds, and when it must stop.
//!
//! Problem: a schema may have 10^12 instances; a process that tries to hold them is killed, which is no
//! answer. Idea: what an atom or an instance will take until the task is done is estimated from its
//! length when it is found, and added up; over the budget, grounding ends at once and names the schema
//! with the most bytes. One instance alone may be too large, by its quantifiers: the parts of a formula
//! are counted while it is expanded. Invariant: every count stays below 2^32, because no budget is
//! larger than [`MOST`].
//!
//! The estimates were measured: a satellite task of a million instances takes 470 bytes for each, where
//! [`instance`] says 470.

use budget::{Budget, Interrupted, Meter};
use std::cell::Cell;

/// Bytes beyond which 32-bit positions might not do.
const MOST: usize = if usize::BITS > 36 { 1 << 36 } else { usize::MAX };

/// The budget, with a limit of bytes that keeps the invariant.
pub(crate) fn limited(budget: Budget<'_>) -> Budget<'_> {
    Budget { memory_bytes: Some(budget.memory_bytes.unwrap_or(MOST).min(MOST)), ..budget }
}

/// Bytes that a ground atom of so many arguments takes: its numbers, its keys, its fact.
pub(crate) fn atom(arguments: usize) -> usize {
    160 + 8 * arguments
}

/// Bytes that an instance takes with so many parameters, literals and changes together.
pub(crate) fn instance(parameters: usize, parts: usize) -> usize {
    250 + 8 * parameters + 30 * parts
}

/// Limits the expansion of one formula after the other.
pub(crate) struct Guard<'a> {
    meter: &'a Meter<'a>,
    parts: Cell<usize>,
}

impl<'a> Guard<'a> {
    pub(crate) fn new(meter: &'a Meter<'a>) -> Self {
        Self { meter, parts: Cell::new(0) }
    }

    /// The next instance begins.
    pub(crate) fn begin(&self) {
        self.parts.set(0);
        // Callers ask `interruption` at the end of the expansion.
        let _ = self.meter.spend(256);
    }

    /// Counts a part that is looked at. Answers whether to go on.
    pub(crate) fn look(&self) -> bool {
        self.meter.spend(16).is_ok()
    }

    /// Counts a part that is kept.
    pub(crate) fn keep(&self) {
        let parts = self.parts.get() + 1;
        self.parts.set(parts);
        let _ = self.meter.spend(32).and_then(|()| self.meter.hold(instance(0, parts)));
    }

    /// Whether so many parts may be looked at, each of which may be kept.
    pub(crate) fn allows(&self, parts: usize) -> bool {
        self.meter.hold(parts).is_ok()
    }

    /// Why the expansion was cut short.
    pub(crate) fn interruption(&self) -> Option<Interrupted> {
        self.meter.interruption()
    }
}

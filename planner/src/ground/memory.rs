//! Estimates the bytes that grounding holds, and stops it at the limit.
//!
//! Problem: a schema may have 10^12 instances. A process that tries to hold them is killed, and the
//! caller gets no answer. Idea: estimate the bytes of an atom or an instance from its length when
//! it is found, and add them up. Above the budget, grounding ends at once and names the schema with
//! the most bytes. A single instance may be too large because of its quantifiers, so the parts of a
//! formula are counted while it is expanded. Invariant: every count stays below 2^32, because no
//! budget is larger than [`MOST`].
//!
//! The estimates agree with measurements: a satellite task of a million instances takes 470 bytes
//! for each, and [`instance`] returns 470.

use budget::{Budget, Interrupted, Meter};
use std::cell::Cell;

/// Above this many bytes, 32-bit positions might overflow.
const MOST: usize = if usize::BITS > 36 { 1 << 36 } else { usize::MAX };

/// The budget, with a limit of bytes that keeps the invariant.
pub(crate) fn limited(budget: Budget<'_>) -> Budget<'_> {
    Budget { memory_bytes: Some(budget.memory_bytes.unwrap_or(MOST).min(MOST)), ..budget }
}

/// The bytes of a ground atom with this many arguments: its numbers, its keys, its fact.
pub(crate) fn atom(arguments: usize) -> usize {
    160 + 8 * arguments
}

/// The bytes of an instance with this many parameters, literals and changes.
pub(crate) fn instance(parameters: usize, parts: usize) -> usize {
    250 + 8 * parameters + 30 * parts
}

/// Limits the expansion of each formula.
pub(crate) struct Guard<'a> {
    meter: &'a Meter<'a>,
    parts: Cell<usize>,
}

impl<'a> Guard<'a> {
    pub(crate) fn new(meter: &'a Meter<'a>) -> Self {
        Self { meter, parts: Cell::new(0) }
    }

    /// Starts the next instance.
    pub(crate) fn begin(&self) {
        self.parts.set(0);
        // Callers check `interruption` at the end of the expansion.
        let _ = self.meter.spend(256);
    }

    /// Counts a part that is read. Returns whether to continue.
    pub(crate) fn look(&self) -> bool {
        self.meter.spend(16).is_ok()
    }

    /// Counts a part that is stored.
    pub(crate) fn keep(&self) {
        let parts = self.parts.get() + 1;
        self.parts.set(parts);
        let _ = self.meter.spend(32).and_then(|()| self.meter.hold(instance(0, parts)));
    }

    /// Whether this many parts may be read and stored.
    pub(crate) fn allows(&self, parts: usize) -> bool {
        self.meter.hold(parts).is_ok()
    }

    /// The reason why the expansion was stopped.
    pub(crate) fn interruption(&self) -> Option<Interrupted> {
        self.meter.interruption()
    }
}

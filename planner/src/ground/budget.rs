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

use super::error::GroundOptions;
use crate::watch::{Spend, Watch};
use std::cell::Cell;

/// Bytes beyond which 32-bit positions might not do.
const MOST: usize = if usize::BITS > 36 { 1 << 36 } else { usize::MAX };

impl GroundOptions<'_> {
    /// The budget in bytes.
    pub(super) fn bytes(&self) -> usize {
        self.memory_bytes.unwrap_or(MOST).min(MOST)
    }
}

/// Bytes that a ground atom of so many arguments takes: its numbers, its keys, its fact.
pub(super) fn atom(arguments: usize) -> usize {
    160 + 8 * arguments
}

/// Bytes that an instance takes with so many parameters, literals and changes together.
pub(super) fn instance(parameters: usize, parts: usize) -> usize {
    250 + 8 * parameters + 30 * parts
}

/// Why an expansion was not finished.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stop {
    /// The caller said so.
    Interrupted,
    /// It is too large.
    Memory,
}

/// Watches over the expansion of one formula after the other.
pub(super) struct Guard<'a> {
    options: &'a GroundOptions<'a>,
    watch: &'a Watch<'a>,
    parts: Cell<usize>,
    stop: Cell<Option<Stop>>,
}

impl<'a> Guard<'a> {
    pub(super) fn new(options: &'a GroundOptions<'a>, watch: &'a Watch<'a>) -> Self {
        Self { options, watch, parts: Cell::new(0), stop: Cell::new(None) }
    }

    /// The next instance begins.
    pub(super) fn begin(&self) {
        self.parts.set(0);
        self.spend(256);
    }

    fn spend(&self, units: usize) {
        if self.watch.try_spend(units).is_err() {
            self.stop.set(Some(Stop::Interrupted));
        }
    }

    /// A part that is looked at. Answers whether to go on.
    pub(super) fn look(&self) -> bool {
        self.spend(16);
        self.stop.get().is_none()
    }

    /// A part that is kept.
    pub(super) fn keep(&self) {
        let parts = self.parts.get() + 1;
        self.parts.set(parts);
        self.spend(32);
        if instance(0, parts) > self.options.bytes() {
            self.stop.set(Some(Stop::Memory));
        }
    }

    /// Whether so many parts may be looked at, each of which may be kept.
    pub(super) fn allows(&self, parts: usize) -> bool {
        if parts > self.options.bytes() {
            self.stop.set(Some(Stop::Memory));
        }
        self.stop.get().is_none()
    }

    /// Whether the expansion was cut short.
    pub(super) fn stopped(&self) -> Option<Stop> {
        self.stop.get()
    }
}

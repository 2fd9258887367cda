//! The budget of one operation, and the reason for an early end.

use std::fmt;

/// Limits of one operation. The default has none.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    /// The most units of work. Each operation documents its unit, such as an expanded state or a tried binding.
    pub work: Option<u64>,
    /// The most bytes to hold. Each operation documents what it counts.
    pub memory_bytes: Option<usize>,
    /// Whether the caller wants an end. The operation asks every fraction of a millisecond.
    pub interrupted: &'a (dyn Fn() -> bool + Sync),
}

impl Default for Budget<'_> {
    fn default() -> Self {
        Self { work: None, memory_bytes: None, interrupted: &|| false }
    }
}

impl fmt::Debug for Budget<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Budget")
            .field("work", &self.work)
            .field("memory_bytes", &self.memory_bytes)
            .finish_non_exhaustive()
    }
}

/// Why an operation ended before it was done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interrupted {
    /// The caller cancelled it.
    Cancelled,
    /// It needs more work than the budget allows.
    Work,
    /// It needs more memory than the budget allows.
    Memory,
}

impl fmt::Display for Interrupted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cancelled => "it was cancelled",
            Self::Work => "it needs more work than its budget allows",
            Self::Memory => "it needs more memory than its budget allows",
        })
    }
}

impl std::error::Error for Interrupted {}

//! What a search may use up.
//!
//! The core reads no clock: a deadline is the caller's closure. It is asked every fraction of a
//! millisecond, also while heuristics are being built, so that a cancellation is seen at once.

/// Limits of one call. The default has none.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    /// Most expanded states.
    pub expansions: Option<u64>,
    /// Most bytes for what grows with a search: states, open lists, what heuristics and novelty remember.
    /// The task and the scratch of heuristics, which are as large as the task, are not counted.
    pub memory_bytes: Option<usize>,
    /// `true` ends the search.
    pub interrupted: &'a (dyn Fn() -> bool + Sync),
}

impl Default for Budget<'_> {
    fn default() -> Self {
        Self { expansions: None, memory_bytes: None, interrupted: &|| false }
    }
}

impl std::fmt::Debug for Budget<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Budget")
            .field("expansions", &self.expansions)
            .field("memory_bytes", &self.memory_bytes)
            .finish_non_exhaustive()
    }
}

/// Which limit ended a search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The caller's `interrupted` said so.
    Interrupted,
    /// As many states were expanded as allowed.
    Expansions,
    /// States and open lists hold as many bytes as allowed.
    Memory,
    /// An incomplete search gave up without an answer.
    Incomplete,
}

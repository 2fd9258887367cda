//! What a search may use up.
//!
//! The core reads no clock: a deadline is the caller's closure. Searches ask it every few
//! evaluations, so that a cancellation is seen within milliseconds.

/// Limits of one call. The default has none.
#[derive(Clone, Copy)]
pub struct Budget<'a> {
    /// Most expanded states.
    pub expansions: Option<u64>,
    /// Most bytes for states and open lists.
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

impl Budget<'_> {
    /// The limit that is exceeded. The closure is asked where `turn` is a
    /// multiple of 16: searches whose steps are dear pass 0.
    pub(crate) fn exceeded(&self, expanded: u64, bytes: usize, turn: u64) -> Option<Limit> {
        if self.expansions.is_some_and(|most| expanded >= most) {
            Some(Limit::Expansions)
        } else if self.memory_bytes.is_some_and(|most| bytes > most) {
            Some(Limit::Memory)
        } else if turn.is_multiple_of(16) && (self.interrupted)() {
            Some(Limit::Interrupted)
        } else {
            None
        }
    }
}

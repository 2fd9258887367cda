//! How a journal is kept.

use std::num::NonZeroU64;
use std::time::Duration;

/// When commits are synced, and so survive a loss of power. What was written survives the end of the process in any
/// case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// Each group of commits at once. A group is one commit if the disk is fast enough.
    Each,
    /// At most this long after the commit.
    Every(Duration),
}

/// How a journal is kept.
#[derive(Debug, Clone)]
pub struct Settings {
    /// When commits are synced.
    pub durability: Durability,
    /// The bytes of deltas after which a segment is closed and another one begins with the present state.
    pub segment_bytes: u64,
    /// The number of segments to keep, the newest ones, including those of earlier journals in the same place; `None`
    /// for all. So a robot that is restarted every day needs no more room than one that is not.
    pub segments: Option<NonZeroU64>,
    /// The most bytes of deltas that may wait for the disk, including those being written and excluding texts, which
    /// the graph shares. When the disk stalls for longer, commits are left out, and the journal continues with a whole
    /// state in a new segment.
    pub waiting_bytes: usize,
}

impl Default for Settings {
    /// A sync every 20 ms, segments of 64 MiB, all of them kept, 64 MiB may wait.
    fn default() -> Self {
        Self {
            durability: Durability::Every(Duration::from_millis(20)),
            segment_bytes: 64 << 20,
            segments: None,
            waiting_bytes: 64 << 20,
        }
    }
}

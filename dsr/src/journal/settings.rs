//! How a journal is kept.

use std::num::NonZeroU64;
use std::time::Duration;

/// When what was committed is synced, so that it outlives a loss of power. What was written outlives the process in any
/// case.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Durability {
    /// At once: each group of commits, which is one commit if the disk is faster than they come.
    Each,
    /// At most this long after the commit.
    Every(Duration),
}

/// How a journal is kept.
#[derive(Debug, Clone)]
pub struct Settings {
    /// When commits are synced.
    pub durability: Durability,
    /// Bytes of deltas after which a segment is closed and one begun with the state of then.
    pub segment_bytes: u64,
    /// How many segments are kept, the newest ones, however many journals wrote them to the same place; all, if `None`.
    /// A robot that is restarted every day needs no more room than one that is not.
    pub segments: Option<NonZeroU64>,
    /// How many bytes of deltas may wait for the disk, those being written included (texts, which the graph shares, not
    /// counted). When it stalls for longer, commits are left out, and the journal goes on with a whole state in a new
    /// segment.
    pub waiting_bytes: usize,
}

impl Default for Settings {
    /// Synced every 20 ms, segments of 64 MiB, all kept, 64 MiB may wait.
    fn default() -> Self {
        Self {
            durability: Durability::Every(Duration::from_millis(20)),
            segment_bytes: 64 << 20,
            segments: None,
            waiting_bytes: 64 << 20,
        }
    }
}

//! A bound on the work that one plan may cost.
//!
//! A quantifier over eight variables or a constraint for every ten objects can be written in a line and
//! not be evaluated in a life. So every binding that is tried is paid for out of one purse, and when it is
//! empty nothing more is found and the plan is refused by name, not judged. The purse is counted and not timed,
//! so that the same plan always gets the same verdict.
//!
//! Invariant: what is found after the purse was empty is never part of a verdict.

use std::sync::atomic::{AtomicU64, Ordering};

/// What any plan may cost.
const ANY_PLAN: u64 = 5_000_000;

/// What a step may cost besides.
const EACH_STEP: u64 = 2_000;

/// How many bindings may still be tried. Atomic only so that a prepared task can be shared by threads.
#[derive(Debug, Default)]
pub(crate) struct Effort(AtomicU64);

impl Effort {
    /// Enough for a plan of so many steps.
    pub(crate) fn for_steps(steps: usize) -> Self {
        let steps = u64::try_from(steps).unwrap_or(u64::MAX);
        Self(AtomicU64::new(EACH_STEP.saturating_mul(steps).saturating_add(ANY_PLAN)))
    }

    /// Pays; answers whether that could be paid.
    pub(crate) fn spend(&self, price: u64) -> bool {
        let left = self.0.load(Ordering::Relaxed);
        self.0.store(left.saturating_sub(price), Ordering::Relaxed);
        left >= price
    }

    /// Whether nothing more can be paid for.
    pub(crate) fn is_spent(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

impl Clone for Effort {
    fn clone(&self) -> Self {
        Self(AtomicU64::new(self.0.load(Ordering::Relaxed)))
    }
}

//! A bound on the work that one plan may cost.
//!
//! A quantifier over eight variables or a constraint for every ten objects can be written in a line and
//! not be evaluated in a life. So every binding that is tried is paid for out of one purse, and when it is
//! empty nothing more is found and the plan is refused by name, not judged. The purse is counted and not timed,
//! so that the same plan always gets the same verdict.
//!
//! The same goes for what cannot be decided exactly, such as which of two roots is first if that takes too long.
//!
//! Invariant: what is found after the purse was empty is never part of a verdict.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// What any plan may cost.
const ANY_PLAN: u64 = 5_000_000;

/// What a step may cost besides.
const EACH_STEP: u64 = 2_000;

/// How many bindings may still be tried. Atomic only so that a prepared task can be shared by threads.
#[derive(Debug, Default)]
pub(crate) struct Effort {
    left: AtomicU64,
    /// Whether something could not be decided exactly.
    undecided: AtomicBool,
}

impl Effort {
    /// Enough for a plan of so many steps.
    pub(crate) fn for_steps(steps: usize) -> Self {
        let steps = u64::try_from(steps).unwrap_or(u64::MAX);
        let left = EACH_STEP.saturating_mul(steps).saturating_add(ANY_PLAN);
        Self { left: AtomicU64::new(left), undecided: AtomicBool::new(false) }
    }

    /// Pays; answers whether that could be paid.
    pub(crate) fn spend(&self, price: u64) -> bool {
        let left = self.left.load(Ordering::Relaxed);
        self.left.store(left.saturating_sub(price), Ordering::Relaxed);
        left >= price
    }

    /// Whether nothing more can be paid for.
    pub(crate) fn is_spent(&self) -> bool {
        self.left.load(Ordering::Relaxed) == 0
    }

    /// Gives the plan up: what comes next depends on what cannot be decided.
    pub(crate) fn give_up(&self) {
        self.undecided.store(true, Ordering::Relaxed);
    }

    /// Goes on after all: the verdict does not depend on it.
    pub(crate) fn take_up(&self) {
        self.undecided.store(false, Ordering::Relaxed);
    }

    /// Whether it was given up.
    pub(crate) fn is_undecided(&self) -> bool {
        self.undecided.load(Ordering::Relaxed)
    }
}

impl Clone for Effort {
    fn clone(&self) -> Self {
        Self {
            left: AtomicU64::new(self.left.load(Ordering::Relaxed)),
            undecided: AtomicBool::new(self.is_undecided()),
        }
    }
}

/// How a search that is one of many is kept short: what it may cost is divided by this.
const BRIEF: u64 = 30;

/// How much a plan is worth that does not say how it comes out of its task network.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Patience {
    /// It is the plan that was asked about.
    #[default]
    Full,
    /// It is one of many that are tried.
    Brief,
}

impl Patience {
    pub(crate) const fn of(self, price: u64) -> u64 {
        match self {
            Self::Full => price,
            Self::Brief => price / BRIEF,
        }
    }
}

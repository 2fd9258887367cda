//! The budget of work for judging one plan.
//!
//! Problem: a quantifier over eight variables, or a constraint for every ten objects, fits into one
//! line of PDDL and cannot be evaluated in a lifetime. Idea: each binding that is tried spends a
//! unit of one budget. Once the budget is exhausted, no search finds anything more, and the
//! validator reports the limit instead of a verdict. Work is counted and not timed, so the same
//! plan always gets the same verdict.
//!
//! The same holds for questions without an exact answer in bounded work, such as which of two roots comes first.
//!
//! Invariant: no verdict contains anything that was found after the budget was exhausted.

use budget::Meter;
use std::sync::atomic::{AtomicBool, Ordering};

/// Units for any plan.
const ANY_PLAN: u64 = 5_000_000;

/// Additional units for each step.
const EACH_STEP: u64 = 2_000;

/// The work of judging one plan, in bindings that are tried.
#[derive(Debug)]
pub(crate) struct Work {
    meter: Meter<'static>,
    /// Whether a question had no exact answer. Atomic only so that threads can share a prepared task.
    undecided: AtomicBool,
}

impl Work {
    /// A budget for a plan of this many steps.
    pub(crate) fn for_steps(steps: usize) -> Self {
        let steps = u64::try_from(steps).unwrap_or(u64::MAX);
        Self::of_units(EACH_STEP.saturating_mul(steps).saturating_add(ANY_PLAN))
    }

    fn of_units(units: u64) -> Self {
        Self { meter: Meter::of_work(units), undecided: AtomicBool::new(false) }
    }

    /// Spends units. Returns whether the budget had that many left.
    pub(crate) fn spend(&self, units: usize) -> bool {
        self.meter.spend(units).is_ok()
    }

    /// Whether the budget has nothing left.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.meter.left() == 0
    }

    /// Records that the verdict depends on a question that has no exact answer.
    pub(crate) fn mark_undecided(&self) {
        self.undecided.store(true, Ordering::Relaxed);
    }

    /// Reverts [`Work::mark_undecided`]: the verdict does not depend on the question after all.
    pub(crate) fn clear_undecided(&self) {
        self.undecided.store(false, Ordering::Relaxed);
    }

    /// Whether the verdict depends on a question that has no exact answer.
    pub(crate) fn is_undecided(&self) -> bool {
        self.undecided.load(Ordering::Relaxed)
    }
}

impl Default for Work {
    /// An empty budget.
    fn default() -> Self {
        Self::of_units(0)
    }
}

impl Clone for Work {
    fn clone(&self) -> Self {
        Self { meter: self.meter.clone(), undecided: AtomicBool::new(self.is_undecided()) }
    }
}

/// The divisor of the budget of a search that is one trial of many.
const BRIEF: u64 = 30;

/// How thoroughly to search for the decomposition of a plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Thoroughness {
    /// The plan is the one to judge.
    #[default]
    Full,
    /// The plan is one trial of many.
    Brief,
}

impl Thoroughness {
    /// The budget at this thoroughness.
    pub(crate) const fn of(self, price: u64) -> u64 {
        match self {
            Self::Full => price,
            Self::Brief => price / BRIEF,
        }
    }
}

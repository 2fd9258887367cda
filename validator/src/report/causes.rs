//! Causes in words, and their places and times.

use super::finding::Place;
use super::words::Words;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::PlanRef;
use pddl::model::{Domain, Problem};

/// The cause in words: `step 3 (go a b)`, `the end of step 3 (go a b) at 4.5`.
pub fn show_cause<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> String {
    Words { domain, problem, plan: plan.into() }.cause(cause)
}

/// The place of the cause.
pub(super) fn cause_place<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Place {
    Words { domain, problem, plan: plan.into() }.cause_place(cause)
}

/// The time of the cause, in seconds; `None` for events and in plans without times.
pub(super) fn cause_time<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Option<Number> {
    Words { domain, problem, plan: plan.into() }.time(cause)
}

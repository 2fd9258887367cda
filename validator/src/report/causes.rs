//! Causes in words, and where and when they are.

use super::finding::Place;
use super::words::Words;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::PlanRef;
use pddl::model::{Domain, Problem};

/// What happened, in words: `step 3 (go a b)`, `the end of step 3 (go a b) at 4.5`.
pub fn show_cause<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> String {
    Words { domain, problem, plan: plan.into() }.cause(cause)
}

/// Where what happened stands.
pub(super) fn cause_place<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Place {
    Words { domain, problem, plan: plan.into() }.cause_place(cause)
}

/// When it happened, in seconds; `None` for events and in plans without times.
pub(super) fn cause_time<'p>(
    domain: &Domain,
    problem: &Problem,
    plan: impl Into<PlanRef<'p>>,
    cause: Cause,
) -> Option<Number> {
    Words { domain, problem, plan: plan.into() }.time(cause)
}

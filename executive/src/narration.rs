//! What the executive reports: one linear stream that terminals, logs and tests only read.

use crate::Step;
use crate::decision_support::Repair;
use crate::monitoring::Deviation;
use crate::outcome::{Ending, NoPlan, StepFailure};
use dsr::TransactionError;
use high_to_low::RefinementEvent;
use serde::{Serialize, Serializer};
use std::fmt::Display;

/// A decision of the executive, with its reason.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Narration {
    /// The plan no longer fits, and why; a new one has been asked for.
    Deviated(Deviation),
    /// A plan was adopted.
    Planned {
        /// Its steps.
        plan: Vec<Step>,
        /// States that the planner expanded.
        expanded: u64,
        /// Whether the step that was running is its first and runs on.
        survives: bool,
        /// How it compares with the rest of the plan before; `None` without one.
        repair: Option<Repair>,
        /// How many plans there have been, this one included.
        count: u32,
    },
    /// A step starts.
    Started {
        /// Its place in the plan, from 0.
        index: usize,
        /// The step.
        step: Step,
    },
    /// The effects of a step have been sensed.
    Achieved {
        /// Its place.
        index: usize,
        /// The step.
        step: Step,
    },
    /// Steps that became unnecessary before they started.
    Skipped {
        /// The steps.
        steps: Vec<Step>,
    },
    /// A step failed, and why.
    Failed {
        /// The step.
        step: Step,
        /// Why.
        #[serde(serialize_with = "as_text")]
        why: StepFailure,
    },
    /// How HighToLow carries a step out.
    Refined {
        /// What it did.
        #[serde(serialize_with = "as_text")]
        what: RefinementEvent,
    },
    /// There is no plan, and why; the fallback starts.
    FellBack {
        /// Why.
        #[serde(serialize_with = "as_text")]
        why: NoPlan,
    },
    /// The graph refused a write of the executive.
    Refused {
        /// Why.
        #[serde(serialize_with = "as_text")]
        why: TransactionError,
    },
    /// The mission is over.
    Ended(Ending),
}

fn as_text<T: Display, S: Serializer>(what: &T, to: S) -> Result<S::Ok, S::Error> {
    to.collect_str(what)
}

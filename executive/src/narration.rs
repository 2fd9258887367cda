//! What the executive tells: one linear stream that terminals, logs and tests only read.

use crate::Step;
use crate::decision_support::Repair;
use crate::monitoring::Deviation;
use crate::wheel::Ending;
use serde::Serialize;

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
        /// How it compares with what was left of the plan before; `None` where there was none.
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
    /// What a step was to achieve has been sensed.
    Achieved {
        /// Its place.
        index: usize,
        /// The step.
        step: Step,
    },
    /// Steps that became needless before they started.
    Skipped {
        /// The steps.
        steps: Vec<Step>,
    },
    /// A step failed, and why.
    Failed {
        /// The step.
        step: Step,
        /// The chain of reasons.
        why: String,
    },
    /// How HighToLow carries a step out.
    Refined {
        /// What it did, as a sentence.
        what: String,
    },
    /// There is no plan, and why; the fallback starts.
    FellBack {
        /// Why.
        why: String,
    },
    /// The graph refused a write of the executive.
    Refused {
        /// Why.
        why: String,
    },
    /// The mission is over.
    Ended(Ending),
}

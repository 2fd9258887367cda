//! What the executive reports: one linear stream that terminals, logs and tests only read.

use crate::Step;
use crate::decision_support::Repair;
use crate::goals::GoalChange;
use crate::monitoring::Deviation;
use crate::outcome::{Ending, NoPlan, StepFailure, Stuck};
use dsr::TransactionError;
use high_to_low::{Failure, RefinementEvent};
use pddl::model::Name;
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
        /// The goals that it serves, those that it serves together in one list, the first ones first; none if the mission
        /// does not name its goals.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        goals: Vec<Vec<Name>>,
    },
    /// Objects of the plan appeared or are gone.
    Objects {
        /// Those that appeared.
        come: Vec<Name>,
        /// Those that are gone.
        gone: Vec<Name>,
    },
    /// A goal passed into another stage of its life.
    Goal(GoalChange),
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
    /// The only plans need steps that have just failed; they are tried again.
    Resting {
        /// The steps.
        steps: Vec<Step>,
        /// In how many seconds, if nothing changes before.
        seconds: f64,
    },
    /// The world moved on while a plan was made, and Decision Support is asked again.
    AskedAgain {
        /// How often in a row.
        times: u32,
    },
    /// The world moved on while a plan was made, and the plan before fits again.
    FitsAgain,
    /// A decision takes its time; this task is carried out meanwhile.
    Meanwhile {
        /// The task.
        task: Step,
    },
    /// There is no plan, and why; the fallback starts.
    FellBack {
        /// Why.
        #[serde(serialize_with = "as_text")]
        why: NoPlan,
    },
    /// The mission does not get on, and why; the task that it names for this starts.
    Escalated {
        /// Why.
        #[serde(serialize_with = "as_text")]
        why: Stuck,
        /// The task.
        task: Step,
    },
    /// The fallback or an escalation failed, and is tried again.
    Retried {
        /// The task.
        task: Step,
        /// Why it failed.
        #[serde(serialize_with = "as_text")]
        why: Failure,
        /// In how many seconds it is tried again.
        seconds: f64,
    },
    /// There is a plan again; the fallback or the escalation is withdrawn.
    Displaced {
        /// The task that is withdrawn.
        task: Step,
    },
    /// The executive did not run for a while; deadlines do not count that time.
    StoodStill {
        /// How long.
        seconds: f64,
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

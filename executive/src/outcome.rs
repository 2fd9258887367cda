//! Why there is no plan, why a step failed, how a mission ended: as data. `wording` makes sentences of it.

use crate::compression::Meanwhile;
use crate::{Model, Step};
use dsr::TransactionError;
use high_to_low::Failure;
use pddl::model::Name;
use planner::Explanation;
use std::fmt;
use std::sync::Arc;

/// Why Decision Support gives no plan.
#[derive(Clone, Debug, PartialEq)]
pub enum NoPlan {
    /// No plan exists.
    Unsolvable(Unsolvable),
    /// None exists in which no action depends on another one that runs at the same time; with that, there may be one.
    Concurrency(Vec<Meanwhile>),
    /// None was found within this many expansions.
    LimitReached(u64),
    /// The domain asks for something that the planner cannot do.
    Unsupported(planner::Feature),
    /// The plan that was found does not validate: a bug of ours, with the validator's finding.
    Invalid(validator::Finding),
    /// With the objects that have appeared, the domain cannot be grounded.
    TooLarge(String),
    /// The planner panicked, a bug of ours, or was cancelled.
    Stopped,
    /// There is none yet: the decision takes longer than this many seconds.
    Late(f64),
    /// There are plans, and the mission has not got on with them, however often that was escalated.
    Stuck(Stuck),
}

/// The proof that no plan exists.
#[derive(Clone)]
pub struct Unsolvable {
    /// The model whose facts the explanation is about.
    pub(crate) model: Arc<Model>,
    /// What can never hold, and why.
    pub(crate) explanation: Explanation,
    /// The steps that were left out because they had just failed.
    pub(crate) barred: Vec<Step>,
}

impl Unsolvable {
    /// From what the planner explains of a model, without these steps.
    pub fn new(model: Arc<Model>, explanation: Explanation, barred: Vec<Step>) -> Self {
        Self { model, explanation, barred }
    }
}

impl fmt::Debug for Unsolvable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Unsolvable")
            .field("explanation", &self.explanation)
            .field("barred", &self.barred)
            .finish_non_exhaustive()
    }
}

/// Two proofs are the same if they say the same.
impl PartialEq for Unsolvable {
    fn eq(&self, other: &Self) -> bool {
        self.explanation == other.explanation && self.barred == other.barred
    }
}

/// Why a step failed.
#[derive(Clone, Debug, PartialEq)]
pub enum StepFailure {
    /// HighToLow could not carry it out.
    Refinement(Failure),
    /// It was carried out, but its effects were not sensed.
    NotSensed,
    /// It took longer than its deadline of so many seconds.
    Late(f64),
    /// The graph refused what it was to write.
    Refused(TransactionError),
}

/// Why a mission that has plans does not get on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Stuck {
    /// So many plans were replaced, and nothing was achieved that had not been before.
    Replans(u32),
    /// One step was started again so often.
    Restarts {
        /// The step.
        step: Step,
        /// How often it was started again.
        times: u32,
    },
    /// So many plans in a row came for a world that had moved on.
    Asks(u32),
    /// These steps failed as often as the mission allows, and there is no plan without them.
    Attempts(Vec<Step>),
}

/// Why the mission's own task is carried out, and not a plan.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// There is no plan.
    NoPlan(NoPlan),
    /// There are plans, and the mission does not get on.
    Stuck(Stuck),
}

/// How a mission ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// The goal was seen to hold.
    Accomplished,
    /// Every goal has ended, and these, which had to be achieved, were given up.
    GivenUp {
        /// Their names.
        goals: Vec<Name>,
    },
    /// There was no plan any more, and the fallback was carried out: the person is with a human.
    WithHuman {
        /// Why there was no plan.
        why: NoPlan,
    },
    /// The horizon of the run came while the fallback or an escalation was still being carried out.
    StillCalling {
        /// Why it was.
        why: Trouble,
    },
    /// The horizon of the run came while the mission was going on.
    StillGoing,
    /// A person ended the run from outside. The wheel never decides this.
    Interrupted,
}

impl Ending {
    /// Its name in records.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Accomplished => "accomplished",
            Self::GivenUp { .. } => "given_up",
            Self::WithHuman { .. } => "with_human",
            Self::StillCalling { .. } => "still_calling",
            Self::StillGoing => "still_going",
            Self::Interrupted => "interrupted",
        }
    }
}

//! Why there is no plan, why a step failed, how a mission ended: as data. `wording` makes sentences of it.

use crate::{Model, Step};
use dsr::TransactionError;
use high_to_low::{Failure, StartError};
use planner::Explanation;
use std::fmt;
use std::sync::Arc;

/// Why Decision Support gives no plan.
#[derive(Clone, Debug, PartialEq)]
pub enum NoPlan {
    /// No plan exists.
    Unsolvable(Unsolvable),
    /// None was found within this many expansions.
    LimitReached(u64),
    /// The domain asks for something that the planner cannot do.
    Unsupported(planner::Feature),
    /// The plan that was found does not validate: a bug of ours, with the validator's finding.
    Invalid(validator::Finding),
    /// The planner panicked: a bug of ours.
    Stopped,
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
    /// The graph refused what it was to write.
    Refused(TransactionError),
}

/// What became of the mission's fallback.
#[derive(Clone, Debug, PartialEq)]
pub enum Fallback {
    /// It was carried out.
    Done,
    /// It could not start.
    NotStarted(StartError),
    /// It failed.
    Failed(Failure),
}

/// How a mission ended.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "there is one, at the end of a mission")]
pub enum Ending {
    /// The goal was seen to hold.
    Accomplished,
    /// The goal was not reached; the fallback was at least tried.
    NotAccomplished {
        /// Why there was no plan any more.
        why: NoPlan,
        /// What became of the fallback.
        fallback: Fallback,
    },
}

//! The outcome of validating a plan, as data.

mod failure;
mod fault;
mod network;
mod unsatisfied;
mod violations;

pub(crate) use failure::Position;
pub use failure::{Breach, Failure, File, Shared};
pub use fault::{ChangeFault, EffectFault, IllFormed, NumericFault, StepFault};
pub use network::{NetworkFault, Parent, Shortfall};
pub use unsatisfied::{Near, Operand, Unsatisfied};
pub use violations::{ViolatedPreference, Violations};

use crate::number::Number;
use pddl::model::Objective;
use pddl::{HierarchicalPlan, Span};

/// The outcome of validating a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// All steps are applicable, and the goal holds in the last state.
    Valid(Valid),
    /// The plan does not solve the problem.
    Invalid(Failure),
    /// The task uses a feature that this crate does not support. Nothing was checked.
    Unsupported(Unsupported),
    /// The task has no meaning. Nothing was checked.
    IllFormed(IllFormed),
}

impl Verdict {
    /// Whether the plan is valid.
    pub fn is_valid(&self) -> bool {
        matches!(self, Self::Valid(_))
    }
}

/// The figures of a valid plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valid {
    /// The number of steps.
    pub steps: u32,
    /// The end of the last step, in seconds; `None` for a plan without times.
    pub makespan: Option<Number>,
    /// The metric, if the problem has one and it has a value in the last state.
    pub metric: Option<MetricValue>,
    /// The preferences that the plan violates.
    pub violations: Violations,
    /// The decomposition that the validator found, if the plan did not give one and the problem has a task network.
    pub decomposition: Option<Box<HierarchicalPlan>>,
}

impl Valid {
    /// The cost of the plan: the metric if it has one, else its makespan, else its number of steps.
    pub fn cost(&self) -> Number {
        let length = self.makespan.unwrap_or(Number::integer(i64::from(self.steps)));
        self.metric.map_or(length, |metric| metric.value)
    }
}

/// The value of the problem's metric.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MetricValue {
    /// Whether to minimise or to maximise it.
    pub objective: Objective,
    /// Its value.
    pub value: Number,
}

/// A use of a feature that is not supported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// The feature.
    pub feature: Feature,
    /// Its place.
    pub span: Span,
}

/// Features that are not supported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Feature {
    /// A construct that the model of the domain leaves out, in the parser's words.
    InDomain(String),
    /// A construct that the model of the problem leaves out, in the parser's words.
    InProblem(String),
    /// A part of the language that the domain uses.
    LanguageOfDomain(pddl::model::Feature),
    /// A part of the language that the problem uses.
    LanguageOfProblem(pddl::model::Feature),
    /// A plan with times for a task network.
    TimedTaskNetwork,
    /// A durative action among the subtasks of the problem.
    DurativeSubtaskOfProblem,
    /// A durative action among the subtasks of a method.
    DurativeSubtaskOfDomain,
    /// Matching the subtasks exceeds its budget.
    MatchLimit,
    /// The search for a decomposition exceeds its budget.
    DecompositionLimit,
    /// A plan without times, where the problem has timed changes.
    TimesMissingForProblem,
    /// A plan without times, where the domain has processes or events.
    TimesMissingForDomain,
    /// Quantifiers or constraints over more combinations of objects than the budget allows.
    TooMuch,
    /// Continuous change with instants that are too close to be ordered, or that are not roots of
    /// polynomials.
    Undecided,
}

/// Why a plan is not accepted: it fails, or the validator cannot judge it.
#[derive(Debug)]
pub(crate) enum Stop {
    Failure(Box<Failure>),
    Unsupported(Unsupported),
}

impl From<Box<Failure>> for Stop {
    fn from(failure: Box<Failure>) -> Self {
        Self::Failure(failure)
    }
}

impl From<NetworkFault> for Stop {
    fn from(fault: NetworkFault) -> Self {
        Self::Failure(Box::new(Failure::Network { fault }))
    }
}

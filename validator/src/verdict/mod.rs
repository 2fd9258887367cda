//! What there is to say about a plan, as data.

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
    /// Every step can be taken and the goal holds in the end.
    Valid(Valid),
    /// It is not a plan for the problem.
    Invalid(Failure),
    /// The task uses a feature whose meaning this crate does not know. Nothing was checked.
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

/// A valid plan's figures.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Valid {
    /// Its length.
    pub steps: u32,
    /// When its last step ends, in seconds; `None` for a plan without times.
    pub makespan: Option<Number>,
    /// The metric, if the problem has one with a value in the last state.
    pub metric: Option<MetricValue>,
    /// The preferences that it does not satisfy.
    pub violations: Violations,
    /// How the steps come out of the problem's task network, if the plan did not say so and it was found.
    pub decomposition: Option<Box<HierarchicalPlan>>,
}

impl Valid {
    /// What the plan costs: the metric where there is one, otherwise how long it takes, or its length.
    pub fn cost(&self) -> Number {
        let length = self.makespan.unwrap_or(Number::integer(i64::from(self.steps)));
        self.metric.map_or(length, |metric| metric.value)
    }
}

/// What the problem's metric comes to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MetricValue {
    /// Which way it should go.
    pub objective: Objective,
    /// Its value.
    pub value: Number,
}

/// A feature whose meaning is not known here.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unsupported {
    /// Which one.
    pub feature: Feature,
    /// Where it is used.
    pub span: Span,
}

/// Features that are not supported.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Something that the domain's model does not hold, in the parser's words.
    InDomain(String),
    /// Something that the problem's model does not hold, in the parser's words.
    InProblem(String),
    /// A part of the language that the domain uses.
    LanguageOfDomain(pddl::model::Feature),
    /// A part of the language that the problem uses.
    LanguageOfProblem(pddl::model::Feature),
    /// A plan with times for a task network.
    TimedTaskNetwork,
    /// An action that takes time among the subtasks of the problem.
    DurativeSubtaskOfProblem,
    /// An action that takes time among the subtasks of a method.
    DurativeSubtaskOfDomain,
    /// Which subtask is which takes too long to find out.
    MatchLimit,
    /// Whether the steps come out of the task network takes too long to find out.
    DecompositionLimit,
    /// A plan without times, where the problem has timed changes.
    TimesMissingForProblem,
    /// A plan without times, where the domain has processes or events.
    TimesMissingForDomain,
    /// Quantifiers and constraints for more objects than can be tried.
    TooMuch,
    /// Continuous change whose instants are too near to each other to tell their order, or no roots of polynomials.
    Undecided,
}

/// Why there is no valid plan to tell of.
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

//! The options and errors of grounding.

use budget::{Budget, Interrupted};
use pddl::Span;
use pddl::model::{FunctionId, Name, PredicateId};

/// The options of grounding.
#[derive(Clone, Copy, Debug, Default)]
pub struct GroundOptions<'a> {
    /// Predicates whose facts an outside event may change. Every type-correct instance becomes a
    /// fact that is never treated as constant and never pruned. A plan can thus start in any
    /// observed state without grounding again.
    pub exogenous: &'a [PredicateId],
    /// Functions whose numbers an outside event may change. Each fluent that something reads may have
    /// any value, or none, in an observed state ([`Task::with_numbers`](crate::Task::with_numbers)).
    pub exogenous_functions: &'a [FunctionId],
    /// Predicates of goals that are asked for later: their facts are kept although nothing else reads them.
    pub kept: &'a [PredicateId],
    /// The limits of grounding. A unit of work takes about a nanosecond. The bytes are an estimate
    /// of the memory for atoms and instances; without a limit, they are limited by what 32-bit
    /// numbers can count.
    pub budget: Budget<'a>,
}

/// A language feature that forward search does not handle yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Numbers with more digits than 128 bits hold.
    LargeNumbers,
    /// Durative actions.
    DurativeActions,
    /// A proof of optimality for a metric that is not a sum of action costs.
    OptimalMetric,
    /// Axioms that depend on their own negation.
    UnstratifiedAxioms,
    /// An initial task network.
    TaskNetwork,
    /// A language feature by name.
    Language(pddl::model::Feature),
    /// A construct that the model cannot represent; the error's span locates it.
    OutsideTheModel,
}

impl std::fmt::Display for Feature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Language(feature) => return feature.fmt(f),
            Self::LargeNumbers => "numbers of more than 38 digits",
            Self::DurativeActions => "durative actions",
            Self::OptimalMetric => "optimal plans by a metric that is not a sum of costs of actions",
            Self::UnstratifiedAxioms => "axioms that depend on their own negation",
            Self::TaskNetwork => "initial task networks",
            Self::OutsideTheModel => "this language feature",
        })
    }
}

/// The text that a span refers to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
}

fn too_large(schema: &Name, instances: usize) -> String {
    match instances {
        0 | 1 => format!("`{schema}` is too large"),
        _ => format!("`{schema}` has {instances} instances or more"),
    }
}

/// The reason why there is no grounded task.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GroundError {
    /// The instances take more bytes than allowed.
    #[error("the grounded task does not fit into the memory: {}", too_large(schema, *instances))]
    Limit {
        /// The action, axiom or predicate with the most bytes.
        schema: Name,
        /// The number of its instances found so far.
        instances: usize,
    },
    /// The caller cancelled, or the work budget was used up.
    #[error("grounding was interrupted in `{schema}`")]
    Interrupted {
        /// The action or axiom that was being grounded, or the one with the most instances.
        schema: Name,
    },
    /// The task needs a feature that the planner does not support.
    #[error("the planner does not support {feature}")]
    Unsupported {
        /// The feature.
        feature: Feature,
        /// The text that uses it.
        origin: Origin,
        /// Its place in the text.
        span: Span,
    },
}

/// The reason why a stage of grounding ended early.
pub(crate) enum Failure {
    Ground(GroundError),
    /// Costs do not add up: an operator improves the metric.
    NegativeCost,
    /// The caller cancelled, or the budget was used up.
    Interrupted,
}

impl From<Interrupted> for Failure {
    fn from(_: Interrupted) -> Self {
        Self::Interrupted
    }
}

impl From<GroundError> for Failure {
    fn from(error: GroundError) -> Self {
        Self::Ground(error)
    }
}

//! What grounding asks for and how it refuses.

use budget::{Budget, Interrupted};
use pddl::Span;
use pddl::model::{Name, PredicateId};

/// How to ground.
#[derive(Clone, Copy, Debug, Default)]
pub struct GroundOptions<'a> {
    /// Predicates whose facts outside events may make true or false: every type-correct instance
    /// becomes a fact that is never taken as constant and never pruned, so that any perceived state
    /// can be planned from without grounding again.
    pub exogenous: &'a [PredicateId],
    /// What grounding may use up. A unit of work takes about a nanosecond; the bytes are an estimate of what
    /// atoms and instances take, and without a limit they are as many as 32-bit numbers can count.
    pub budget: Budget<'a>,
}

/// A language feature that forward search does not handle yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// Numbers of more digits than 128 bits hold.
    LargeNumbers,
    /// Durative actions.
    DurativeActions,
    /// A proof that no plan is better, by a metric that is not a sum of costs of actions.
    OptimalMetric,
    /// Axioms that depend on their own negation.
    UnstratifiedAxioms,
    /// An initial task network.
    TaskNetwork,
    /// A part of the language.
    Language(pddl::model::Feature),
    /// What the model itself does not hold; the span tells.
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

/// Whose text a span is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The domain's.
    Domain,
    /// The problem's.
    Problem,
}

fn too_large(schema: &Name, instances: usize) -> String {
    match instances {
        0 | 1 => format!("`{schema}` is too large"),
        _ => format!("`{schema}` has {instances} instances or more"),
    }
}

/// Why there is no grounded task.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum GroundError {
    /// The instances take more bytes than allowed.
    #[error("the grounded task does not fit into the memory: {}", too_large(schema, *instances))]
    Limit {
        /// The action, axiom or predicate that blew up.
        schema: Name,
        /// How many of its instances were found until then.
        instances: usize,
    },
    /// The caller cancelled, or the work was used up.
    #[error("grounding was interrupted in `{schema}`")]
    Interrupted {
        /// The action or axiom at work, or with the most instances.
        schema: Name,
    },
    /// The task needs what the planner does not do.
    #[error("the planner does not support {feature}")]
    Unsupported {
        /// What.
        feature: Feature,
        /// Whose text.
        origin: Origin,
        /// Where.
        span: Span,
    },
}

/// Why a stage of grounding ended early.
pub(crate) enum Failure {
    Ground(GroundError),
    /// Costs are no sum: an operator improves the metric.
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

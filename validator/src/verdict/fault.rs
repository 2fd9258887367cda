//! Faults of steps, numbers, effects and tasks that are not about a condition.

use crate::number::NoResult;
use pddl::Span;
use pddl::model::{GroundApplication, ObjectId, PredicateId, VariableId};

/// Why a step is not an instance of an action.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepFault {
    /// There is no such action.
    UnknownAction,
    /// The number of arguments is wrong.
    Arity {
        /// Parameters of the action.
        expected: usize,
        /// Arguments of the step.
        found: usize,
    },
    /// A durative action has no duration.
    NoDuration,
    /// An argument is not of its parameter's type.
    Type {
        /// The parameter.
        parameter: VariableId,
        /// The argument.
        object: ObjectId,
    },
}

/// Why an expression has no value.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NumericFault {
    /// A fluent has no value.
    Undefined {
        /// The fluent.
        fluent: GroundApplication,
        /// The place where it is read.
        span: Span,
    },
    /// A divisor is zero.
    DivisionByZero {
        /// The division.
        span: Span,
    },
    /// The result is too large for a double.
    Overflow {
        /// The operation.
        span: Span,
    },
    /// `?duration` in an instantaneous action.
    Duration {
        /// The place of `?duration`.
        span: Span,
    },
}

impl NumericFault {
    pub(crate) fn of(result: NoResult, span: Span) -> Self {
        match result {
            NoResult::DivisionByZero => Self::DivisionByZero { span },
            NoResult::Overflow => Self::Overflow { span },
        }
    }

    /// The place of the fault.
    pub fn span(&self) -> Span {
        match self {
            Self::Undefined { span, .. }
            | Self::DivisionByZero { span }
            | Self::Overflow { span }
            | Self::Duration { span } => *span,
        }
    }
}

/// Why effects have no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum EffectFault {
    /// Two effects give a fluent different values.
    Conflict {
        /// The fluent.
        fluent: GroundApplication,
        /// One effect.
        first: Span,
        /// The other.
        second: Span,
    },
    /// A value cannot be computed.
    Numeric(NumericFault),
}

/// Why continuous change has no result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ChangeFault {
    /// A value cannot be computed.
    Numeric(NumericFault),
    /// A rate depends on itself: the change is not a polynomial of time.
    NotPolynomial {
        /// The fluent.
        fluent: GroundApplication,
        /// Its rate.
        span: Span,
    },
    /// Processes begin and end endlessly at one time.
    Unsteady,
    /// The divisor changes: the result is not a polynomial of time.
    NotPolynomialExpression {
        /// The division.
        span: Span,
    },
}

/// Why a task has no meaning although each of its parts has one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IllFormed {
    /// A derived predicate depends on its own negation.
    Unstratified {
        /// The predicate.
        predicate: PredicateId,
        /// An axiom on the cycle.
        span: Span,
    },
    /// An action adds or deletes an atom of a derived predicate.
    DerivedInEffect {
        /// The predicate.
        predicate: PredicateId,
        /// The effect.
        span: Span,
    },
}

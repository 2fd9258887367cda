//! What is wrong with a step, a number, an effect or a task, where no condition is at fault.

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
        /// Which one.
        fluent: GroundApplication,
        /// Where it is read.
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
    /// `?duration`, which no instantaneous action has.
    Duration {
        /// Where it stands.
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

    /// Where it is.
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
    /// A rate depends on itself: the change is no polynomial of time.
    NotPolynomial {
        /// The fluent.
        fluent: GroundApplication,
        /// Its rate.
        span: Span,
    },
    /// Processes begin and end without end, at one time.
    Unsteady,
    /// Something is divided by what changes: the result is no polynomial of time.
    NotPolynomialExpression {
        /// The division.
        span: Span,
    },
}

/// Why a task has no meaning although each of its parts has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum IllFormed {
    /// A derived predicate depends on its own negation.
    Unstratified {
        /// The predicate.
        predicate: PredicateId,
        /// An axiom on the circle.
        span: Span,
    },
    /// An action adds or deletes what axioms derive.
    DerivedInEffect {
        /// The predicate.
        predicate: PredicateId,
        /// The effect.
        span: Span,
    },
}

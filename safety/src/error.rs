//! Why an invariant cannot be monitored.

use vocabulary::{LinkErrorKind, Located};

/// Why an invariant cannot be monitored.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ErrorKind {
    /// A condition is not about the graph.
    #[error(transparent)]
    Condition(#[from] LinkErrorKind),
    /// These two operators count states, so their operands are about one state.
    #[error(
        "the operands of `at-most-once` and `sometime-before` are conditions on one state, without operators"
    )]
    Operator,
    /// Time is dense, and whether this holds may change at any moment of a state.
    #[error(
        "below another operator, only a condition on one state may be negated or stand before its consequence"
    )]
    Negated,
    /// The same for windows.
    #[error("`hold-after` and `hold-during` do not stand below another operator")]
    Window,
    /// A time beyond the range of the clock.
    #[error("this time is longer than 500 years")]
    TooLong,
}

/// A part of an invariant that cannot be monitored, with its place.
pub type Error = Located<ErrorKind>;

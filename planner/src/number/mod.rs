//! How effects move expressions over numeric fluents.
//!
//! The numbers and the expressions are those of [`analysis`].

mod influence;

pub(crate) use influence::Influence;

pub use analysis::Number;
pub(crate) use analysis::{Expression, NoValue, Operator};

/// How a number relates to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Relation {
    /// Above.
    Positive,
    /// Not below.
    NonNegative,
    /// Equal.
    Zero,
    /// Above or below.
    NonZero,
    /// In any way: it is a number.
    Defined,
}

impl Relation {
    pub(crate) fn holds(self, sign: i32) -> bool {
        match self {
            Self::Positive => sign > 0,
            Self::NonNegative => sign >= 0,
            Self::Zero => sign == 0,
            Self::NonZero => sign != 0,
            Self::Defined => true,
        }
    }
}

/// How a fluent changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Change {
    Assign,
    /// Adds.
    Shift,
    /// Multiplies.
    Scale,
}

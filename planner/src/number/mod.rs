//! How effects change expressions over numeric fluents.
//!
//! The numbers and expressions come from [`analysis`].

mod influence;

pub(crate) use influence::Influence;

pub use analysis::Number;
pub(crate) use analysis::{Expression, NoValue, Operator};

/// The relation of a number to 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Relation {
    /// Above 0.
    Positive,
    /// Not below 0.
    NonNegative,
    /// Equal to 0.
    Zero,
    /// Not equal to 0.
    NonZero,
    /// Any relation: the value is defined.
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

/// How an effect changes a fluent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Change {
    Assign,
    /// Adds a value.
    Shift,
    /// Multiplies by a value.
    Scale,
}

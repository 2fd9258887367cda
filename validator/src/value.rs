//! Ground atoms, and the values of fluents.

use crate::number::Number;
use pddl::model::{FluentValue, ObjectId, PredicateId};

/// A predicate applied to objects.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GroundAtom {
    /// The predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
}

/// The value of a fluent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// A number.
    Number(Number),
    /// An object.
    Object(ObjectId),
}

impl Value {
    /// The value that a file gives; `None` for a number that is not finite.
    pub(crate) fn of(value: FluentValue) -> Option<Self> {
        match value {
            FluentValue::Number(number) => Number::from_f64(number).map(Self::Number),
            FluentValue::Object(object) => Some(Self::Object(object)),
        }
    }
}

//! Ground atoms, and the values of fluents.

use crate::number::Number;
use pddl::model::{FluentValue, ObjectId, PredicateId};

/// A predicate of objects.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct GroundAtom {
    /// Which predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Box<[ObjectId]>,
}

/// What a fluent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Value {
    /// A number.
    Number(Number),
    /// An object.
    Object(ObjectId),
}

impl Value {
    /// What a file gives a fluent; `None` if it is no finite number.
    pub(crate) fn of(value: FluentValue) -> Option<Self> {
        match value {
            FluentValue::Number(number) => Number::from_f64(number).map(Self::Number),
            FluentValue::Object(object) => Some(Self::Object(object)),
        }
    }
}

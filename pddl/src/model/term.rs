//! Terms: the arguments of predicates, functions, tasks and skills.

use super::{ObjectId, VariableId};

/// A variable or a constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Term {
    /// A slot of the schema.
    Variable(VariableId),
    /// A constant or object.
    Object(ObjectId),
}

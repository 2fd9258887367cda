//! Initial facts, of problems and of domains (`:timeless`).

use super::{ObjectId, PredicateId};
use crate::Span;

/// A ground atom that holds initially.
#[derive(Clone, Debug)]
pub struct Fact {
    /// Which predicate.
    pub predicate: PredicateId,
    /// Its arguments.
    pub arguments: Vec<ObjectId>,
    /// Where it stands.
    pub span: Span,
}

//! The predicates that represent object fluents.
//!
//! Grounding compiles a function `(f ?x) - t` into a predicate `(f ?x ?value)`. Names, facts and
//! explanations map such an atom back to its fluent and value.

use crate::ids::id32;
use pddl::model::{Domain, FunctionId, GroundApplication, ObjectId, PredicateId};

/// The predicates that represent functions; they follow the declared ones.
#[derive(Clone, Debug)]
pub(crate) struct ValuePredicates {
    first: u32,
    functions: Vec<FunctionId>,
}

impl ValuePredicates {
    /// The predicates of these functions, in this order.
    pub(crate) fn new(domain: &Domain, functions: Vec<FunctionId>) -> Self {
        Self { first: id32(domain.predicates.len()), functions }
    }

    /// No predicates, for a domain without object fluents.
    pub(crate) fn none(domain: &Domain) -> Self {
        Self::new(domain, Vec::new())
    }

    pub(crate) fn function(&self, predicate: PredicateId) -> Option<FunctionId> {
        self.functions.get(predicate.0.checked_sub(self.first)? as usize).copied()
    }

    /// The fluent and the value that an atom represents.
    pub(crate) fn value(
        &self,
        predicate: PredicateId,
        arguments: &[ObjectId],
    ) -> Option<(GroundApplication, ObjectId)> {
        let function = self.function(predicate)?;
        let (&value, arguments) = arguments.split_last()?;
        Some((GroundApplication { function, arguments: arguments.to_vec() }, value))
    }
}

//! The variables of one schema (action, axiom, method, goal).
//!
//! Every variable of a schema, parameter or quantified, has a slot of its own, so a binding is an array and
//! substitution never captures. The first [`Variables::parameters`] slots are the parameters.

use super::{IndexVec, Name, TypeSet, VariableId};
use crate::Span;

/// A typed variable.
#[derive(Clone, Debug)]
pub struct Variable {
    /// Its name without the question mark.
    pub name: Name,
    /// What it ranges over.
    pub types: TypeSet,
    /// Where it was declared.
    pub span: Span,
}

/// All variables of a schema.
#[derive(Clone, Debug, Default)]
pub struct Variables {
    /// Every slot.
    pub slots: IndexVec<VariableId, Variable>,
    /// How many of the first slots are parameters.
    pub parameters: usize,
}

impl Variables {
    /// The parameters' slots.
    pub fn parameter_ids(&self) -> impl DoubleEndedIterator<Item = VariableId> + ExactSizeIterator + use<> {
        (0..self.parameters).map(super::Idx::from_index)
    }

    /// The parameters.
    pub fn parameters(&self) -> &[Variable] {
        &self.slots.as_slice()[..self.parameters]
    }
}

impl std::ops::Index<VariableId> for Variables {
    type Output = Variable;
    fn index(&self, id: VariableId) -> &Variable {
        &self.slots[id]
    }
}

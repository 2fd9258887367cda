//! The variables of one schema, with their types in the graph.

use dsr::TypeId;
use pddl::model::{Idx, Name, VariableId};

use crate::tokens::ValueSort;

/// A variable with its type in the graph.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slot {
    /// Its name without the question mark.
    pub name: Name,
    /// The node types over which it ranges, without subtypes of one another; empty if it stands for a value.
    pub types: Vec<TypeId>,
    /// The kind of value, if it stands for one.
    pub value: Option<ValueSort>,
}

/// All variables of one schema, parameters first.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Scope {
    pub(crate) slots: Vec<Slot>,
    pub(crate) parameters: usize,
}

impl Scope {
    /// A variable.
    ///
    /// # Panics
    /// If the variable is of another schema.
    pub fn slot(&self, variable: VariableId) -> &Slot {
        &self.slots[variable.index()]
    }

    /// The parameters.
    pub fn parameters(&self) -> impl Iterator<Item = VariableId> + use<> {
        (0..self.parameters).map(VariableId::from_index)
    }

    /// All variables, by id.
    pub fn slots(&self) -> &[Slot] {
        &self.slots
    }

    /// Whether the variable stands for nodes.
    pub fn is_node(&self, variable: VariableId) -> bool {
        self.slot(variable).value.is_none()
    }
}

//! The variables of one schema, with their types in the graph.

use dsr::TypeId;
use pddl::model::{Idx, Name, VariableId};

use crate::tokens::ValueSort;

/// A variable as the graph sees it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slot {
    /// Its name without the question mark.
    pub name: Name,
    /// The node types over which it ranges, none below another; empty if it stands for a value.
    pub types: Vec<TypeId>,
    /// The kind of value for which it stands, if it does.
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

    /// How many variables there are.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Whether the variable stands for nodes.
    pub fn is_node(&self, variable: VariableId) -> bool {
        self.slot(variable).value.is_none()
    }
}

//! What the variables of a schema stand for.
//!
//! Parameters stand for nodes; the results of a skill may also be text, truth values or poses.

use dsr::{Isometry3, NodeId, Value};
use pddl::model::{Idx, VariableId, Variables};

/// A value that is not a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Datum {
    /// A number, text or truth value.
    Value(Value),
    /// A rigid transform.
    Pose(Isometry3<f64>),
}

/// What some of the variables of one schema stand for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Binding {
    nodes: Vec<Option<NodeId>>,
    /// Sorted by variable; few or none.
    values: Vec<(VariableId, Datum)>,
}

impl Binding {
    /// None of these variables bound.
    pub fn of(variables: &Variables) -> Self {
        Self { nodes: vec![None; variables.slots.len()], values: Vec::new() }
    }

    /// The node for which a variable stands.
    pub fn node(&self, variable: VariableId) -> Option<NodeId> {
        self.nodes.get(variable.index()).copied().flatten()
    }

    /// The value for which a variable stands.
    pub fn value(&self, variable: VariableId) -> Option<&Datum> {
        self.values.binary_search_by_key(&variable, |(v, _)| *v).ok().map(|at| &self.values[at].1)
    }

    /// The nodes by variable: what two bindings of parameters are compared by.
    pub fn nodes(&self) -> &[Option<NodeId>] {
        &self.nodes
    }

    /// Lets a variable stand for a node.
    pub fn bind(&mut self, variable: VariableId, node: NodeId) -> &mut Self {
        if self.nodes.len() <= variable.index() {
            self.nodes.resize(variable.index() + 1, None);
        }
        self.nodes[variable.index()] = Some(node);
        self
    }

    /// Lets a variable stand for a value.
    pub fn bind_value(&mut self, variable: VariableId, datum: Datum) -> &mut Self {
        match self.values.binary_search_by_key(&variable, |(v, _)| *v) {
            Ok(at) => self.values[at].1 = datum,
            Err(at) => self.values.insert(at, (variable, datum)),
        }
        self
    }

    /// The same with one more node.
    #[must_use]
    pub fn with(mut self, variable: VariableId, node: NodeId) -> Self {
        self.bind(variable, node);
        self
    }
}

//! Bindings: the nodes and values of a schema's variables.
//!
//! Parameters stand for nodes. The results of a skill may also be text, truth values or poses.

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

/// Nodes and values for some of the variables of one schema.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Binding {
    nodes: Vec<Option<NodeId>>,
    /// Sorted by variable. Most bindings have no values.
    values: Vec<(VariableId, Datum)>,
}

impl Binding {
    /// A binding of these variables in which all are free.
    pub fn of(variables: &Variables) -> Self {
        Self { nodes: vec![None; variables.slots.len()], values: Vec::new() }
    }

    /// The node that a variable is bound to.
    pub fn node(&self, variable: VariableId) -> Option<NodeId> {
        self.nodes.get(variable.index()).copied().flatten()
    }

    /// The value that a variable is bound to.
    pub fn value(&self, variable: VariableId) -> Option<&Datum> {
        self.values.binary_search_by_key(&variable, |(v, _)| *v).ok().map(|at| &self.values[at].1)
    }

    /// The nodes by variable. Two bindings of parameters are the same if these are.
    pub fn nodes(&self) -> &[Option<NodeId>] {
        &self.nodes
    }

    /// Binds a variable to a node.
    pub fn bind(&mut self, variable: VariableId, node: NodeId) -> &mut Self {
        if self.nodes.len() <= variable.index() {
            self.nodes.resize(variable.index() + 1, None);
        }
        self.nodes[variable.index()] = Some(node);
        self
    }

    /// Binds a variable to a value.
    pub fn bind_value(&mut self, variable: VariableId, datum: Datum) -> &mut Self {
        match self.values.binary_search_by_key(&variable, |(v, _)| *v) {
            Ok(at) => self.values[at].1 = datum,
            Err(at) => self.values.insert(at, (variable, datum)),
        }
        self
    }
}

//! A task or an intention with its arguments.

use pddl::model::Name;

/// A compound task or an intention, with the names of the nodes that it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GroundTask {
    /// The task or the intention.
    pub name: Name,
    /// Its arguments. A node that has left the graph has the name `?`.
    pub arguments: Vec<Name>,
}

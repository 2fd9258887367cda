//! Where a name is declared.

use project::{Place, Project};

use crate::Position;

/// Where a name is declared.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Definition {
    /// The name that was asked about.
    pub origin: Place,
    /// Its declarations: several if domains that a file imports declare it, or a problem repeats a constant.
    pub targets: Vec<Target>,
}

/// A declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Target {
    /// The whole declaration.
    pub full: Place,
    /// The name in it.
    pub name: Place,
}

/// Where the name at a position is declared.
pub fn definition(_project: &Project, _at: Position) -> Option<Definition> {
    None
}

//! What a name means.

use project::{Place, Project};

use crate::Position;

/// What to show over a name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hover {
    /// What it is about.
    pub place: Place,
    /// What to show, as Markdown.
    pub markdown: String,
}

/// What stands at a position.
pub fn hover(_project: &Project, _at: Position) -> Option<Hover> {
    None
}

//! What can be folded away.

use pddl::Span;
use project::{Project, SourceId};

/// What is folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoldKind {
    /// A list over several lines.
    List,
    /// Lines of comment below each other.
    Comment,
}

/// A piece that can be folded away.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fold {
    /// All of it.
    pub span: Span,
    /// What it is.
    pub kind: FoldKind,
}

/// What can be folded in a file, in order of place.
pub fn folding(_project: &Project, _source: SourceId) -> Vec<Fold> {
    Vec::new()
}

//! Lines over declarations: what can be run, how often a name is used.

use pddl::Span;
use project::{Project, SourceId};

/// What a lens says and does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lens {
    /// Plan for the problem in this file, with that domain file.
    Plan {
        /// The domain's file.
        domain: SourceId,
    },
    /// Validate the plan in this file for that problem.
    Validate {
        /// The domain's file.
        domain: SourceId,
        /// The problem's file.
        problem: SourceId,
    },
    /// How often the name below is used in the project.
    References {
        /// Uses, without declarations.
        count: usize,
    },
}

/// A line over a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CodeLens {
    /// The name below the line.
    pub span: Span,
    /// What it says.
    pub lens: Lens,
}

/// The lenses of a file, in order of place.
pub fn code_lenses(_project: &Project, _source: SourceId) -> Vec<CodeLens> {
    Vec::new()
}

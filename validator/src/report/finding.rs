//! A sentence about a plan, with its place in one of the three files.

use crate::verdict::File;
use pddl::Span;
use serde::Serialize;

/// A place in one of the three texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// The file.
    pub file: File,
    /// The place in the file.
    pub span: Span,
}

/// A sentence about a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// One sentence without a full stop.
    pub sentence: String,
    /// The place of the finding.
    pub place: Place,
    /// Its details, the most important first.
    pub notes: Vec<(Place, String)>,
}

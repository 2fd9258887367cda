//! A sentence about a plan, with its place in one of the three files.

use crate::verdict::File;
use pddl::Span;
use serde::Serialize;

/// A place in one of the three texts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Which text.
    pub file: File,
    /// Where in it.
    pub span: Span,
}

/// A sentence about a plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// One sentence without a full stop.
    pub sentence: String,
    /// Where.
    pub place: Place,
    /// Its details, the most important first.
    pub notes: Vec<(Place, String)>,
}

//! Changes of texts, for somebody else to make.

use std::collections::BTreeMap;

use diagnostics::SourceId;
use pddl::Span;

/// A piece of a file and what to put in its place.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextEdit {
    /// What goes; empty to insert only.
    pub span: Span,
    /// What comes.
    pub text: String,
}

/// Changes of several files. Those of one file do not overlap and are in order of place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edits {
    /// By file.
    pub files: BTreeMap<SourceId, Vec<TextEdit>>,
}

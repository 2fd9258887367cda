//! Changes of texts as data; the caller applies them.

use std::collections::BTreeMap;

use diagnostics::SourceId;
use pddl::Span;

/// A place in a file and its new text.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextEdit {
    /// The replaced span; empty for an insertion.
    pub span: Span,
    /// The new text.
    pub text: String,
}

/// Changes of several files. Those of one file do not overlap and are in order of place.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edits {
    /// By file.
    pub files: BTreeMap<SourceId, Vec<TextEdit>>,
}

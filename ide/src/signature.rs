//! What an applied symbol takes, while its arguments are written.

use project::Project;

use crate::Position;

/// A signature and which argument is being written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SignatureHelp {
    /// `(at ?who - person ?where - place)`
    pub label: String,
    /// Where in the label each parameter is, in bytes.
    pub parameters: Vec<std::ops::Range<usize>>,
    /// Which parameter is being written; `None` behind the last.
    pub active: Option<usize>,
    /// The comment at the declaration, as Markdown.
    pub documentation: Option<String>,
}

/// The signature of the symbol whose arguments stand around a position.
pub fn signature_help(_project: &Project, _at: Position) -> Option<SignatureHelp> {
    None
}

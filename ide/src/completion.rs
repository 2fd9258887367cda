//! What may stand at a position.

use pddl::{NameKind, Span};
use project::Project;

use crate::Position;

/// What a completion puts in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A word of the language.
    Keyword,
    /// A section or form with places to fill in.
    Snippet,
    /// A name.
    Name(NameKind),
}

/// Something that may stand at a position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// What to show in the list.
    pub label: String,
    /// What it is.
    pub kind: CompletionKind,
    /// Signature or type, beside the label.
    pub detail: Option<String>,
    /// More, as Markdown.
    pub documentation: Option<String>,
    /// What goes: the word so far.
    pub span: Span,
    /// What comes, without places to fill in.
    pub text: String,
    /// What comes, with `$1`, `${2:name}` … `$0` to fill in, in the syntax of language servers.
    pub snippet: Option<String>,
    /// Smaller is better: fitting types first, then what is nearest.
    pub rank: u32,
}

/// What may stand at a position, best first.
pub fn completions(_project: &Project, _at: Position) -> Vec<Completion> {
    Vec::new()
}

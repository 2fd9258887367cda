//! One completion.

use pddl::{NameKind, Span};

/// The kind of a completion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompletionKind {
    /// A word of the language.
    Keyword,
    /// A section or form with places to fill in.
    Snippet,
    /// A name.
    Name(NameKind),
}

/// A candidate for a position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Completion {
    /// Its text in the list.
    pub label: String,
    /// Its kind.
    pub kind: CompletionKind,
    /// Signature or type, beside the label.
    pub detail: Option<String>,
    /// Documentation, as Markdown.
    pub documentation: Option<String>,
    /// The replaced span: the word so far.
    pub span: Span,
    /// The inserted text, without placeholders.
    pub text: String,
    /// The inserted text with placeholders `$1`, `${2:name}` … `$0`, in the syntax of language servers.
    pub snippet: Option<String>,
    /// The rank, smaller is better: fitting types first, then the nearest.
    pub rank: u32,
}

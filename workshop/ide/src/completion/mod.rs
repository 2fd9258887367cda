//! Completion: the names and words that fit a position.
//!
//! Problem: the text is broken exactly where the author is typing. Idea: [`Context`] finds the open lists
//! from the tokens before the cursor. `expected` derives from them what kind of thing fits. `candidates`
//! asks the drafts, which lack only the broken parts, for names of that kind. Editors filter by the typed
//! prefix.

mod candidates;
mod expected;
mod snippets;

use pddl::{NameKind, Span};
use project::{FileKind, Project};

use crate::Position;
use crate::context::Context;

use candidates::Candidates;
use expected::expected;

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

/// The candidates for a position, best first.
pub fn completions(project: &Project, at: Position) -> Vec<Completion> {
    let Some(context) = Context::of(project.source(at.source), at.offset) else { return Vec::new() };
    let is_plan = project.kind(at.source) == FileKind::Plan;
    let Some(expected) = expected(&context, is_plan) else { return Vec::new() };
    let mut found = Candidates { project, at, context: &context, all: Vec::new() };
    found.collect(expected);
    let mut all = found.all;
    all.sort_by(|a, b| (a.rank, &a.label).cmp(&(b.rank, &b.label)));
    all
}

//! What may stand at a position.
//!
//! Problem: while somebody types, the text is broken just there. Idea: [`Context`] tells from the tokens before the
//! cursor which lists are open; `expected` tells from these what may stand there; `candidates` asks the drafts,
//! which lack only what is broken, for names that fit. Editors filter by what was typed so far.

mod candidates;
mod expected;
mod snippets;

use pddl::{NameKind, Span};
use project::{FileKind, Project};

use crate::Position;
use crate::context::Context;

use candidates::Candidates;
use expected::expected;

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

//! Completion: the names and words that fit a position.
//!
//! Problem: the text is broken exactly where the author is typing. Idea: [`Context`] finds the open lists
//! from the tokens before the cursor. `expected` derives from them what kind of thing fits. `candidates`
//! asks the drafts, which lack only the broken parts, for names of that kind. Editors filter by the typed
//! prefix.

mod candidates;
mod expected;
mod item;
mod snippets;

use project::{FileKind, Project};

use crate::Position;
use crate::context::Context;

use candidates::Candidates;
use expected::expected;
pub use item::{Completion, CompletionKind};

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

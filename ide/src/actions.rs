//! What can be done about a finding, or about a name.

use pddl::Span;
use project::{Project, SourceId};

use crate::Edits;

/// Why an action is offered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ActionKind {
    /// It makes a finding go away.
    Fix,
    /// It changes the text and not its meaning.
    Refactor,
}

/// A change to offer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CodeAction {
    /// What it does, in the imperative.
    pub title: String,
    /// Why it is offered.
    pub kind: ActionKind,
    /// The finding's code and place if it is a fix.
    pub fixes: Option<(&'static str, Span)>,
    /// Whether it is the one to take if there are several.
    pub preferred: bool,
    /// What it changes.
    pub edits: Edits,
}

/// What can be done where `range` is.
pub fn code_actions(_project: &Project, _source: SourceId, _range: Span) -> Vec<CodeAction> {
    Vec::new()
}

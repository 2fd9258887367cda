//! A file laid out anew, as changes of its text.

use pddl::Span;
use project::{Project, SourceId};

use crate::TextEdit;

/// What to change so that the file is laid out as `pelea fmt` does; `None` while its parentheses do not match.
pub fn format(_project: &Project, _source: SourceId) -> Option<Vec<TextEdit>> {
    None
}

/// Of these changes, those in the lines that `range` touches.
pub fn format_range(_project: &Project, _source: SourceId, _range: Span) -> Option<Vec<TextEdit>> {
    None
}

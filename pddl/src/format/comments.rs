//! Comments behind code: at the author's distance, and in columns.
//!
//! Consecutive comments that stood in one column, without an empty line between them, get a common column
//! again: the nearest one in which the widest line keeps the smallest distance that any of them had. Two
//! such groups that end up in one column have the same distance together as apart, so formatting again
//! changes nothing.

use crate::Span;

/// The tabulator width of the source.
const TAB: usize = 8;

/// A comment that is to be placed behind a line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Trailing {
    /// Where it starts in the text that is being written.
    pub(super) at: usize,
    /// Columns that the line before it takes.
    pub(super) column: usize,
    /// Column it had in the source.
    was_column: usize,
    /// Blanks it had before it.
    gap: usize,
    /// How many empty lines are above it.
    pub(super) paragraph: usize,
}

impl Trailing {
    /// The comment at `comment`, behind the token that ends at `before`.
    pub(super) fn new(
        text: &str,
        comment: Span,
        before: u32,
        at: usize,
        column: usize,
        paragraph: usize,
    ) -> Self {
        let start = text[..before as usize].rfind(['\n', '\r']).map_or(0, |i| i + 1);
        let columns = |from: usize, part: &str| {
            part.chars().fold(from, |c, ch| if ch == '\t' { c / TAB * TAB + TAB } else { c + 1 })
        };
        let left = columns(0, &text[start..before as usize]);
        let was_column = columns(left, &text[before as usize..comment.start as usize]);
        Self { at, column, was_column, gap: (was_column - left).max(1), paragraph }
    }
}

/// Puts blanks before the comments.
pub(super) fn align(text: &str, comments: &[Trailing]) -> String {
    let mut aligned = String::with_capacity(text.len() + comments.len() * 4);
    let mut from = 0;
    for group in comments.chunk_by(|a, b| (a.was_column, a.paragraph) == (b.was_column, b.paragraph)) {
        let widest = group.iter().map(|c| c.column).max().unwrap_or(0);
        let gap = group.iter().map(|c| c.gap).min().unwrap_or(1);
        for comment in group {
            aligned.push_str(&text[from..comment.at]);
            aligned.extend(std::iter::repeat_n(' ', widest + gap - comment.column));
            from = comment.at;
        }
    }
    aligned.push_str(&text[from..]);
    aligned
}

//! Formatting a file, as edits.
//!
//! Only differing pieces are replaced, so that marks and cursors stay where they are.

use diagnostics::SourceId;
use pddl::syntax::{self, TokenKind};
use pddl::{Source, Span};
use project::Project;

use crate::TextEdit;

/// The edits that lay the file out as `pelea fmt` does; `None` while its parentheses do not match.
pub fn format(project: &Project, source: SourceId) -> Option<Vec<TextEdit>> {
    let old = project.source(source);
    let text = pddl::format(old).ok()?;
    let new = Source::new("", text);
    let (before, after) = (pieces(old), pieces(&new));
    let mut edits = Vec::new();
    for (old_piece, new_piece) in before.iter().zip(&after) {
        for (o, n) in [(old_piece.blank, new_piece.blank), (old_piece.word, new_piece.word)] {
            if old.slice(o) != new.slice(n) {
                edits.push(TextEdit { span: o, text: new.slice(n).to_owned() });
            }
        }
    }
    Some(edits)
}

/// Of these edits, those in the lines that `range` touches.
pub fn format_range(project: &Project, source: SourceId, range: Span) -> Option<Vec<TextEdit>> {
    let text = project.source(source);
    let line = |offset: u32| text.line_column(offset).line;
    let (first, last) = (line(range.start), line(range.end));
    let mut edits = format(project, source)?;
    edits.retain(|edit| line(edit.span.end) >= first && line(edit.span.start) <= last);
    Some(edits)
}

/// A word with the white space before it. The formatter changes only white space, that at the end of a
/// comment included.
struct Piece {
    blank: Span,
    word: Span,
}

fn pieces(source: &Source) -> Vec<Piece> {
    let (tree, _) = syntax::parse(source);
    let mut pieces = Vec::new();
    let mut from = 0;
    for (kind, span) in tree.tokens() {
        if kind != TokenKind::Whitespace {
            pieces.push(Piece { blank: Span::new(from, span.start), word: span });
            from = span.end;
        }
    }
    let end = u32::try_from(source.text().len()).expect("a source is shorter than 4 GiB");
    pieces.push(Piece { blank: Span::new(from, end), word: Span::new(end, end) });
    pieces
}

//! Finds the list that was never closed by the layout of the author's lines.
//!
//! Problem: where a parenthesis is missing, each list takes the closing parenthesis of the list around it.
//! At the end of the section the section itself is still open, and not the list that its author forgot to
//! close. Idea: authors indent by nesting. A list has ended before
//! - a key (`:effect`) of the section that it stands in, wherever that is,
//! - an opening parenthesis or key that starts a line in the list's column or left of it,
//! - a closing parenthesis that starts a line left of the line on which the list begins.
//!
//! The last two rules apply only if the preceding sections, whose parentheses are right, follow them. No
//! rule applies to a section whose parentheses balance. Cost: one more pass over a wrong section. Columns
//! are counted in bytes.

use super::token::TokenKind;
use super::tokens::Tokens;
use crate::Span;

/// Keywords of sections that hold keys and their values.
const KEYED: &[&str] = &[
    ":action",
    ":axiom",
    ":constraint",
    ":durative-action",
    ":event",
    ":htn",
    ":method",
    ":process",
    ":task",
];

/// Keys that stand in such sections only, and directly in them.
const KEYS: &[&str] = &[
    ":agent",
    ":claims",
    ":condition",
    ":constraints",
    ":context",
    ":duration",
    ":effect",
    ":expansion",
    ":implies",
    ":observe",
    ":order",
    ":ordered-subtasks",
    ":ordered-tasks",
    ":ordering",
    ":parameters",
    ":precondition",
    ":skill",
    ":subtasks",
    ":task",
    ":tasks",
    ":vars",
];

/// Which signs of a list's end count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Signs {
    /// Keys alone.
    Keys,
    /// Keys and columns.
    KeysAndColumns,
}

/// An open list.
#[derive(Clone, Copy)]
struct Open {
    column: usize,
    line: Line,
    /// How many parts begin on its first line. With one part, the others are indented from that line and not
    /// from the parenthesis.
    beside: usize,
}

impl Open {
    /// Whether it has ended before an opening parenthesis or a key that starts a line in `column`.
    fn ends_before(&self, column: usize) -> bool {
        let starts_line = self.column == self.line.indent;
        if self.beside > 1 || starts_line { column <= self.column } else { column < self.line.indent }
    }
}

/// Where a line is, and what starts it.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Line {
    start: usize,
    /// Column of its first token.
    indent: usize,
}

/// Looks for at most `missing` ends of lists in the section that starts at `section.start`. Each result is
/// the place of a token before which the innermost open list should have ended; a place occurs once for each
/// such list.
pub(super) fn missing_ends(text: &str, section: Span, missing: usize, signs: Signs) -> Vec<u32> {
    let mut ends = Vec::new();
    let mut open: Vec<Open> = Vec::new();
    let line_start = text[..section.start as usize].rfind(['\n', '\r']).map_or(0, |at| at + 1);
    let mut line = Line { start: line_start, indent: section.start as usize - line_start };
    let (mut starts_line, mut after_open, mut keyed) = (false, false, false);
    for (kind, span) in Tokens::within(text, section) {
        let start = span.start as usize;
        if kind == TokenKind::Whitespace {
            if let Some(at) = text[span.range()].rfind(['\n', '\r']) {
                (starts_line, line.start) = (true, start + at + 1);
            }
            continue;
        }
        let column = start - line.start;
        if starts_line {
            line.indent = column;
        }
        let by_column = starts_line && signs == Signs::KeysAndColumns;
        let ended = |list: &Open| match kind {
            _ if !by_column || list.line == line => false,
            TokenKind::Open | TokenKind::Keyword => list.ends_before(column),
            TokenKind::Close => column < list.line.indent,
            _ => false,
        };
        let inner = open.get(1..).unwrap_or_default();
        let is_key = kind == TokenKind::Keyword && keyed && !after_open && is_key(&text[span.range()]);
        let count =
            if is_key { inner.len() } else { inner.iter().rev().take_while(|list| ended(list)).count() };
        if count + ends.len() > missing {
            // More lists have ended than are missing: from here on the signs are not reliable.
            break;
        }
        ends.extend(std::iter::repeat_n(span.start, count));
        open.truncate(open.len() - count);
        if let Some(outer) = open.last_mut().filter(|list| kind != TokenKind::Close && list.line == line) {
            outer.beside += 1;
        }
        match kind {
            TokenKind::Open => open.push(Open { column, line, beside: 0 }),
            TokenKind::Close => {
                open.pop();
                if open.is_empty() {
                    break;
                }
            }
            TokenKind::Keyword if open.len() == 1 && after_open => {
                keyed = is_one_of(&text[span.range()], KEYED);
            }
            _ => {}
        }
        (starts_line, after_open) = (false, kind == TokenKind::Open);
    }
    ends
}

/// Whether the keyword is a key that stands directly in a section only.
pub(super) fn is_key(keyword: &str) -> bool {
    is_one_of(keyword, KEYS)
}

fn is_one_of(keyword: &str, words: &[&str]) -> bool {
    words.iter().any(|word| word.eq_ignore_ascii_case(keyword))
}

//! The first pass: how wide every list is on one line, and whether it must be broken.
//!
//! Invariant: a list that holds a comment or a list that must be broken must be broken itself.

use super::rules::{Rules, Shape};
use crate::Span;
use crate::syntax::{TokenKind, Tokens};

/// Longest line that lists are fitted to, in characters.
pub(super) const WIDTH: usize = 100;

/// A token that is not white space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) kind: TokenKind,
    pub(super) span: Span,
    /// Line ends before it; 2 stands for more.
    pub(super) lines: u8,
    /// Whether it follows the previous token without white space.
    pub(super) glued: bool,
    /// For an opening parenthesis: the number of its list.
    pub(super) list: u32,
    /// The column where it would end if everything were on one line.
    pub(super) end: usize,
}

/// The measurements of a list.
#[derive(Clone, Copy, Debug)]
pub(super) struct List {
    pub(super) rules: Rules,
    /// Index of the closing parenthesis.
    pub(super) close: usize,
    /// It cannot stand on one line.
    pub(super) forced: bool,
    /// The author broke it, after the parts that stay on the first line.
    pub(super) broken: bool,
    /// The author broke it directly after those parts.
    pub(super) opened: bool,
    pub(super) holds_lists: bool,
    pub(super) holds_types: bool,
}

/// A text, measured.
#[derive(Debug)]
pub(super) struct Measured<'s> {
    pub(super) text: &'s str,
    pub(super) pieces: Vec<Piece>,
    lists: Vec<List>,
}

impl Measured<'_> {
    pub(super) fn text_of(&self, index: usize) -> &str {
        &self.text[self.pieces[index].span.range()]
    }

    /// The list that opens at a piece.
    pub(super) fn list(&self, index: usize) -> Option<&List> {
        let piece = self.pieces.get(index)?;
        (piece.kind == TokenKind::Open).then(|| &self.lists[piece.list as usize])
    }

    /// The last piece of the part that starts at `index`: the closing parenthesis of a list.
    pub(super) fn last_of(&self, index: usize) -> usize {
        self.list(index).map_or(index, |list| list.close)
    }

    /// Columns that the pieces `first..=last` need on one line, with the closing parentheses after them.
    pub(super) fn width(&self, first: usize, last: usize) -> usize {
        let piece = &self.pieces[first];
        let length = self.text_of(first).chars().count();
        let closing = self.pieces[last + 1..]
            .iter()
            .take_while(|p| p.kind == TokenKind::Close)
            .take(MOST_CLOSING)
            .count();
        self.pieces[last].end + length - piece.end + closing
    }

    pub(super) fn is_hyphen(&self, index: usize) -> bool {
        self.pieces[index].kind == TokenKind::Name && self.text_of(index) == "-"
    }
}

/// Closing parentheses beyond this number are not counted: the line is full anyway.
const MOST_CLOSING: usize = WIDTH;

/// A list that is not closed yet.
struct Open {
    list: usize,
    parts: u32,
    /// The part before was a hyphen.
    hyphen: bool,
}

pub(super) fn measure<'s>(text: &'s str, tokens: Tokens<'_>) -> Measured<'s> {
    let mut measured = Measured { text, pieces: Vec::with_capacity(text.len() / 6), lists: Vec::new() };
    let mut open: Vec<Open> = Vec::new();
    let (mut lines, mut glued, mut end) = (0, true, 0);
    let mut before = TokenKind::Open;
    for (kind, span) in tokens {
        if kind == TokenKind::Whitespace {
            lines = (lines + line_ends(&text[span.range()])).min(2);
            glued = false;
            continue;
        }
        let index = measured.pieces.len();
        if kind != TokenKind::Comment {
            let apart = before != TokenKind::Open && kind != TokenKind::Close;
            end += usize::from(apart) + text[span.range()].chars().count();
            before = kind;
        }
        let mut piece = Piece { kind, span, lines, glued, list: u32::MAX, end };
        match kind {
            TokenKind::Close => {
                if let Some(closed) = open.pop() {
                    let list = &mut measured.lists[closed.list];
                    list.close = index;
                    let forced = list.forced;
                    if let Some(outer) = open.last() {
                        measured.lists[outer.list].forced |= forced;
                    }
                }
            }
            TokenKind::Comment => {
                if let Some(inner) = open.last() {
                    let list = &mut measured.lists[inner.list];
                    list.forced = true;
                    list.broken |= lines > 0 && inner.parts >= list.rules.beside;
                    list.opened |= lines > 0 && inner.parts == list.rules.beside;
                }
            }
            _ => {
                if let Some(outer) = open.last_mut() {
                    part(&mut measured.lists[outer.list], outer, &piece, &text[span.range()]);
                }
                if kind == TokenKind::Open {
                    piece.list = u32::try_from(measured.lists.len()).expect("fewer lists than bytes");
                    open.push(Open { list: measured.lists.len(), parts: 0, hyphen: false });
                    measured.lists.push(List {
                        rules: Rules::of(TokenKind::Open, ""),
                        close: index,
                        forced: false,
                        broken: false,
                        opened: false,
                        holds_lists: false,
                        holds_types: false,
                    });
                }
            }
        }
        measured.pieces.push(piece);
        (lines, glued) = (0, true);
    }
    measured
}

/// Counts another part of a list.
fn part(list: &mut List, open: &mut Open, piece: &Piece, text: &str) {
    if open.parts == 0 {
        list.rules = Rules::of(piece.kind, text);
        list.forced |= list.rules.shape == Shape::Define;
    } else {
        list.holds_lists |= piece.kind == TokenKind::Open;
        let key = piece.kind == TokenKind::Keyword;
        if key && list.rules.shape == Shape::Section && !list.rules.is_flags {
            list.rules.shape = Shape::Keyed;
            list.rules.beside = 1;
        }
    }
    let hyphen = open.parts >= list.rules.types_from() && piece.kind == TokenKind::Name && text == "-";
    list.holds_types |= hyphen;
    if piece.lines > 0 && open.parts >= list.rules.beside && !hyphen && !open.hyphen {
        list.broken = true;
        list.opened |= open.parts == list.rules.beside;
        list.forced |= list.rules.keeps;
    }
    open.hyphen = hyphen;
    open.parts += 1;
}

/// How many line ends a piece of white space holds; `\r\n` is one.
fn line_ends(blank: &str) -> u8 {
    let bytes = blank.as_bytes();
    let ends = (0..bytes.len())
        .filter(|&i| bytes[i] == b'\n' || (bytes[i] == b'\r' && bytes.get(i + 1) != Some(&b'\n')))
        .take(2)
        .count();
    u8::from(ends > 0) + u8::from(ends > 1)
}

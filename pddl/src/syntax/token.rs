//! Tokens: consecutive pieces that tile the text.
//!
//! Only the end of each token is stored; it starts where the one before it ends. So the tokens
//! cover every byte once *by construction*, and one costs 5 bytes.

use crate::Span;

/// What a token is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// Blanks, line ends, a byte order mark.
    Whitespace,
    /// `; …` up to the line's end.
    Comment,
    /// `(`
    Open,
    /// `)`
    Close,
    /// A name or an operator: whatever is none of the others.
    Name,
    /// `?name`
    Variable,
    /// `:name`
    Keyword,
    /// `5`, `-1.5`, `.5`, `1e-3`
    Number,
}

/// All tokens of a text.
#[derive(Clone, Debug, Default)]
pub struct Tokens {
    kinds: Vec<TokenKind>,
    ends: Vec<u32>,
}

impl Tokens {
    /// Room for the tokens of a text of `bytes` bytes, by what PDDL files have on average.
    pub(super) fn for_text(bytes: usize) -> Self {
        Self { kinds: Vec::with_capacity(bytes / 3), ends: Vec::with_capacity(bytes / 3) }
    }

    /// Appends the token that ends at `end`.
    pub(super) fn push(&mut self, kind: TokenKind, end: u32) {
        self.kinds.push(kind);
        self.ends.push(end);
    }

    /// How many.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }

    /// Whether the text is empty.
    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }

    /// All tokens in order; each span starts where the one before it ends.
    pub fn iter(&self) -> impl Iterator<Item = (TokenKind, Span)> + '_ {
        let mut start = 0;
        self.kinds.iter().zip(&self.ends).map(move |(&kind, &end)| {
            let span = Span::new(start, end);
            start = end;
            (kind, span)
        })
    }
}

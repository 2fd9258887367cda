//! The tokens of a text: consecutive pieces that cover every byte once.
//!
//! Tokens are not stored. A caller that wants them lexes the text again, which is faster than reading most of them
//! from memory would be. Each token starts where the previous one ends, so they tile the text *by construction*.

use super::lexer::first_token;
use super::token::TokenKind;
use crate::Span;

/// All tokens of a text, in order.
#[derive(Clone, Debug)]
pub struct Tokens<'s> {
    text: &'s str,
    /// How much of the text has been read.
    at: usize,
}

impl<'s> Tokens<'s> {
    /// The tokens of that text.
    pub(super) fn of(text: &'s str) -> Self {
        Self { text, at: 0 }
    }

    /// The tokens of a part that starts and ends at token boundaries; their spans are those of the whole
    /// text.
    pub(super) fn within(text: &'s str, part: Span) -> Self {
        Self { text: &text[..part.end as usize], at: part.start as usize }
    }
}

impl Iterator for Tokens<'_> {
    type Item = (TokenKind, Span);

    fn next(&mut self) -> Option<(TokenKind, Span)> {
        let rest = self.text.as_bytes().get(self.at..).filter(|rest| !rest.is_empty())?;
        let (length, kind) = first_token(rest);
        let place = |at: usize| u32::try_from(at).expect("a source is shorter than 4 GiB");
        let span = Span::new(place(self.at), place(self.at + length));
        self.at += length;
        Some((kind, span))
    }
}

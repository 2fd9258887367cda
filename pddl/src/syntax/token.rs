//! The kinds of tokens.

/// The kind of a token.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// Blanks, line ends, a byte order mark.
    Whitespace,
    /// `; …` up to the end of the line.
    Comment,
    /// `(`
    Open,
    /// `)`
    Close,
    /// A name or an operator: any word of no other kind.
    Name,
    /// `?name`
    Variable,
    /// `:name`
    Keyword,
    /// `5`, `-1.5`, `.5`, `1e-3`
    Number,
}

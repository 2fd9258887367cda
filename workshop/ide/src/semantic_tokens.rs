//! Semantic tokens: the kind of each word, for colours by meaning.

use diagnostics::SourceId;
use pddl::syntax::{self, TokenKind};
use pddl::{NameKind, Role, Span};
use project::Project;

use crate::entity::occurrences;

/// The kind of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenRole {
    /// `;` up to the line's end.
    Comment,
    /// A word of the language.
    Keyword,
    /// `=`, `<`, `+` …
    Operator,
    /// A number.
    Number,
    /// A name, declared or used.
    Name(NameKind, Role),
}

/// A word and its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SemanticToken {
    /// Its place, within one line.
    pub span: Span,
    /// Its kind.
    pub role: TokenRole,
}

/// Words that are names only if a declaration has that name.
const OPERATORS: &[&str] = &["=", "<", "<=", ">=", ">", "+", "-", "*", "/", "#t"];

/// The words of a file, or those that `range` touches, in order and without overlaps.
pub fn semantic_tokens(project: &Project, source: SourceId, range: Option<Span>) -> Vec<SemanticToken> {
    let text = project.source(source);
    let (tree, _) = syntax::parse(text);
    let mut names = occurrences(project, source).iter().peekable();
    let mut tokens = Vec::new();
    for (kind, span) in tree.tokens() {
        while names.next_if(|o| o.span.start < span.start).is_some() {}
        let name = names.peek().filter(|o| o.span == span);
        let role = match (kind, name) {
            (TokenKind::Whitespace | TokenKind::Open | TokenKind::Close, _) => continue,
            (TokenKind::Comment, _) => TokenRole::Comment,
            (_, Some(o)) => TokenRole::Name(o.symbol.kind, o.role),
            (TokenKind::Number, None) => TokenRole::Number,
            (TokenKind::Variable, None) => TokenRole::Name(NameKind::Variable, Role::Use),
            (TokenKind::Keyword, None) => TokenRole::Keyword,
            (TokenKind::Name, None) if OPERATORS.contains(&text.slice(span)) => TokenRole::Operator,
            (TokenKind::Name, None) => TokenRole::Keyword,
        };
        if range.is_none_or(|range| span.start <= range.end && range.start <= span.end) {
            tokens.push(SemanticToken { span, role });
        }
    }
    tokens
}

//! `textDocument/semanticTokens`, of a whole document and of a range.
//!
//! Source: Language Server Protocol 3.17, "Semantic Tokens": five numbers a token, each place relative to the token
//! before it.

use super::{Question, Refusal};
use diagnostics::SourceId;
use ide::TokenRole;
use lsp_types::{
    SemanticToken, SemanticTokens, SemanticTokensLegend, SemanticTokensParams, SemanticTokensRangeParams,
};
use pddl::{NameKind, Role, Span};

/// The types of tokens, by their numbers. All are in the protocol, so every theme has colours for them.
const TYPES: [&str; 14] = [
    "comment",
    "keyword",
    "operator",
    "number",
    "namespace",
    "type",
    "property",
    "function",
    "enumMember",
    "variable",
    "method",
    "event",
    "label",
    "decorator",
];
const DECLARATION: u32 = 1;

/// The names of the numbers.
pub(crate) fn legend() -> SemanticTokensLegend {
    SemanticTokensLegend {
        token_types: TYPES.iter().map(|name| (*name).to_owned()).collect(),
        token_modifiers: vec!["declaration".to_owned()],
    }
}

pub(crate) fn full(
    q: &Question<'_>,
    params: &SemanticTokensParams,
) -> Result<Option<SemanticTokens>, Refusal> {
    Ok(q.documents.id(&params.text_document.uri).map(|source| tokens(q, source, None)))
}

pub(crate) fn range(
    q: &Question<'_>,
    params: &SemanticTokensRangeParams,
) -> Result<Option<SemanticTokens>, Refusal> {
    let source = q.documents.id(&params.text_document.uri);
    Ok(source.map(|source| tokens(q, source, Some(q.documents.span(source, params.range)))))
}

fn tokens(q: &Question<'_>, source: SourceId, range: Option<Span>) -> SemanticTokens {
    let (mut line, mut character) = (0, 0);
    let mut data = Vec::new();
    for token in ide::semantic_tokens(q.project(), source, range) {
        let at = q.documents.range(source, token.span);
        let same_line = at.start.line == line;
        let (delta_line, delta_start) = match same_line {
            true => (0, at.start.character.saturating_sub(character)),
            false => (at.start.line.saturating_sub(line), at.start.character),
        };
        (line, character) = (at.start.line, at.start.character);
        let (name, token_modifiers_bitset) = role(token.role);
        data.push(SemanticToken {
            delta_line,
            delta_start,
            length: at.end.character.saturating_sub(at.start.character),
            token_type: number(name),
            token_modifiers_bitset,
        });
    }
    SemanticTokens { result_id: None, data }
}

fn number(name: &str) -> u32 {
    let index = TYPES.iter().position(|known| *known == name);
    index.and_then(|index| u32::try_from(index).ok()).unwrap_or_default()
}

fn role(role: TokenRole) -> (&'static str, u32) {
    match role {
        TokenRole::Comment => ("comment", 0),
        TokenRole::Keyword => ("keyword", 0),
        TokenRole::Operator => ("operator", 0),
        TokenRole::Number => ("number", 0),
        TokenRole::Name(kind, role) => (name(kind), if role == Role::Declaration { DECLARATION } else { 0 }),
    }
}

fn name(kind: NameKind) -> &'static str {
    match kind {
        NameKind::Domain | NameKind::Problem => "namespace",
        NameKind::Requirement => "decorator",
        NameKind::Type => "type",
        NameKind::Predicate => "property",
        NameKind::Function => "function",
        NameKind::Object => "enumMember",
        NameKind::Variable => "variable",
        NameKind::Action | NameKind::Task | NameKind::Method | NameKind::Skill => "method",
        NameKind::Process | NameKind::Event => "event",
        NameKind::Subtask | NameKind::Preference | NameKind::Invariant | NameKind::Agent => "label",
    }
}

#[cfg(test)]
mod tests {
    use super::{TYPES, name, number};
    use pddl::NameKind;

    #[test]
    fn every_type_is_in_the_legend() {
        for kind in [
            NameKind::Domain,
            NameKind::Requirement,
            NameKind::Type,
            NameKind::Predicate,
            NameKind::Function,
            NameKind::Object,
            NameKind::Variable,
            NameKind::Action,
            NameKind::Process,
            NameKind::Subtask,
        ] {
            assert!(TYPES.contains(&name(kind)));
        }
        assert_eq!(number("comment"), 0);
        assert_eq!(number("decorator"), 13);
    }
}

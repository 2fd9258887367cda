//! `:writes`: which agent may write which token, and between which nodes.
//!
//! A binary function is an edge and its attribute, so a permission to write it becomes two. A bare symbol permits the
//! token anywhere; a constant fixes one end.

use dsr::{End, Permission, Token};
use pddl::model::{Domain, TokenPattern, TokenSymbol};

use crate::declarations::Reader;
use crate::token_error::{TokenError, TokenErrorKind};
use crate::tokens::{FunctionToken, Tokens};

impl Tokens {
    /// Reads a domain as a vocabulary.
    ///
    /// # Errors
    /// Every declaration that does not fit the graph.
    pub fn new(domain: &Domain) -> Result<Self, Vec<TokenError>> {
        let mut reader = Reader::new(domain);
        permissions(&mut reader);
        reader.finish()
    }
}

fn permissions(reader: &mut Reader<'_>) {
    let domain = reader.domain;
    for permission in &domain.permissions {
        let Some(&agent) = reader.agents.get(&permission.agent) else {
            let name = permission.agent.clone();
            reader.error(permission.span, TokenErrorKind::NotAnAgent { name });
            continue;
        };
        for pattern in &permission.tokens {
            for token in tokens(reader, pattern) {
                let granted = Permission::between(token, end(reader, pattern, 0), end(reader, pattern, 1));
                let permitted = reader.builder.permit(agent, granted);
                reader.take(pattern.span, permitted);
            }
        }
    }
}

fn tokens(reader: &mut Reader<'_>, pattern: &TokenPattern) -> Vec<Token> {
    let domain = reader.domain;
    match pattern.symbol {
        TokenSymbol::Predicate(id) => {
            reader.labels.get(&domain.predicates[id].name).copied().map(Token::Label).into_iter().collect()
        }
        TokenSymbol::Function(id) => {
            let name = domain.functions[id].name.clone();
            match reader.functions.get(&name).copied() {
                Some(FunctionToken::Node { attribute }) => vec![Token::Attribute(attribute)],
                Some(FunctionToken::Edge { label, attribute }) => {
                    vec![Token::Label(label), Token::Attribute(attribute)]
                }
                Some(FunctionToken::Transform) => vec![Token::Transform],
                Some(FunctionToken::Distance | FunctionToken::Pose(_)) => {
                    reader.error(pattern.span, TokenErrorKind::Computed { name });
                    Vec::new()
                }
                None => Vec::new(),
            }
        }
        TokenSymbol::Type(id) => reader.node_type(id).map(Token::Node).into_iter().collect(),
    }
}

fn end(reader: &Reader<'_>, pattern: &TokenPattern, at: usize) -> End {
    let fixed = pattern.arguments.get(at).copied().flatten();
    fixed.and_then(|id| reader.constant_name(id)).map_or(End::Any, |name| End::named(name.as_str()))
}

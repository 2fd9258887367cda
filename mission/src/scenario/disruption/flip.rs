//! The token that a disruption flips: `"(is_with person robot)"`, or one of all that fit `"(is_with _ _)"`.
//!
//! In a library `_` stands for any predicate and any node, and the campaign chooses the token of each run. Only tokens
//! that some agent may write are among them: what a confused agent could do to the graph. `except` names predicates that
//! are left out.

use std::fmt;
use std::sync::Arc;

use pddl::Span;
use pddl::model::{Domain, Name, ObjectId, PredicateId, TokenSymbol};

use super::super::names;
use crate::layers::Layers;
use crate::manifest::{Mention, symbols};
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Table, Text};

/// What stands for any predicate or node.
const ANY: &str = "_";

/// An edge of the graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Token {
    /// The label.
    pub label: Name,
    /// The nodes from which and to which it goes.
    pub ends: [Name; 2],
}

impl fmt::Display for Token {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({} {} {})", self.label, self.ends[0], self.ends[1])
    }
}

/// What is flipped.
pub(super) enum Flipped {
    /// This token.
    This(Token),
    /// One of these, all that fit.
    OneOf(Vec<Token>, Span),
}

/// Reads `token` of a disruption that flips one.
pub(super) fn read(reader: &mut Reader<'_>, layers: &Layers, table: &mut Table<'_>) -> Option<Flipped> {
    let text = table.required_text(reader, "token")?;
    let mentions = symbols(&text);
    let [label, from, to] = mentions.as_slice() else {
        reader.error(
            "E0908",
            text.span,
            "a token is a predicate with two nodes, as in \"(is_with person robot)\"",
        );
        return None;
    };
    let predicate = match predicate(reader, layers, label) {
        Ok(predicate) => predicate,
        Err(()) => return None,
    };
    if mentions.iter().all(|mention| &*mention.name != ANY) {
        let predicate = predicate?;
        let mut end = |mention: &Mention, position| {
            let text = Text::new(&mention.name, mention.span, "");
            names::argument(reader, layers, &text, predicate, position, "node for this token")
        };
        let ends = [end(from, 0)?, end(to, 1)?].map(|id| layers.graph.model.objects[id].name.clone());
        return Some(Flipped::This(Token { label: label.name.clone(), ends }));
    }
    let except = table.texts(reader, "except").unwrap_or_default();
    for name in &except {
        let mention = Mention { name: Name::new(&name.value), span: name.span };
        let _ = self::predicate(reader, layers, &mention);
    }
    let mut tokens = fitting(layers, predicate, [from, to]);
    tokens.retain(|token| except.iter().all(|name| *name.value != *token.label));
    if tokens.is_empty() {
        reader.error("E0908", text.span, "no token that an agent may write fits");
        return None;
    }
    Some(Flipped::OneOf(tokens, text.span))
}

/// The predicate of that name; `None` if it may be any.
fn predicate(reader: &mut Reader<'_>, layers: &Layers, label: &Mention) -> Result<Option<PredicateId>, ()> {
    let found = layers.nodes.predicate(&label.name);
    if found.is_some() || &*label.name == ANY {
        return Ok(found);
    }
    let known = layers.nodes.predicates.enumerate().map(|(_, p)| p.name.as_str());
    let message = format!("there is no token `{}`", label.name);
    let finding = Finding::error("E0908", reader.place(label.span), message);
    reader.findings.push(finding.help_if(did_you_mean(&label.name, known)));
    Err(())
}

/// All tokens that fit and that some agent may write, in the order of declaration.
fn fitting(layers: &Layers, predicate: Option<PredicateId>, ends: [&Mention; 2]) -> Vec<Token> {
    let (domain, objects) = (&layers.nodes, &layers.graph.model.objects);
    let mut tokens = Vec::new();
    let candidates = domain.predicates.enumerate().filter(|(id, _)| predicate.is_none_or(|only| only == *id));
    for (_, candidate) in candidates {
        let [from, to] = candidate.variables.parameters() else { continue };
        let fits = |id: ObjectId, types, end: &Mention| {
            let object = &objects[id];
            object.is_of(types, &domain.types) && (&*end.name == ANY || object.name == end.name)
        };
        for x in objects.ids().filter(|&x| fits(x, &from.types, ends[0])) {
            for y in objects.ids().filter(|&y| fits(y, &to.types, ends[1])) {
                let ends = [objects[x].name.clone(), objects[y].name.clone()];
                let token = Token { label: candidate.name.clone(), ends };
                if is_written(&layers.vocabulary.model, &token) {
                    tokens.push(token);
                }
            }
        }
    }
    tokens
}

/// Whether some agent may write a token.
fn is_written(vocabulary: &Domain, token: &Token) -> bool {
    let patterns = vocabulary.permissions.iter().flat_map(|permission| &permission.tokens);
    patterns.into_iter().any(|pattern| {
        let TokenSymbol::Predicate(id) = pattern.symbol else { return false };
        vocabulary.predicates[id].name == token.label
            && pattern
                .arguments
                .iter()
                .zip(&token.ends)
                .all(|(fixed, end)| fixed.is_none_or(|constant| vocabulary.constants[constant].name == *end))
    })
}

/// The tokens of a disruption whose token is open, by their labels.
pub(in super::super) fn by_label(tokens: &[Token]) -> Vec<(Name, Arc<[Token]>)> {
    let groups = tokens.chunk_by(|a, b| a.label == b.label);
    groups.map(|group| (group[0].label.clone(), group.into())).collect()
}

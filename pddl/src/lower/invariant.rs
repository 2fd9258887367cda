//! `(:invariant NAME :parameters (…) :says (…) :constraint …)`: what every run must satisfy.

use super::action::named;
use super::body::Body;
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::world::World;
use crate::diagnostic::DiagnosticKind;
use crate::model::{Invariant, Requirement, Word};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

const KEYS: &[&str] = &[":parameters", ":says", ":constraint"];

pub(crate) fn invariant(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Invariant> {
    if !world.has(Requirement::Invariants) {
        let requirement = Requirement::Invariants.as_str();
        sink.report(
            first_word(section),
            DiagnosticKind::NeedsRequirement { name: ":invariant".into(), requirement },
        );
    }
    let (name, name_span, rest) = named(sink, section, NameKind::Invariant, "the invariant")?;
    let keys = Keys::read(sink, rest, "an invariant", KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    let says = keys.get(":says").map(|node| body.words(node)).unwrap_or_default();
    let constraint = match keys.get(":constraint") {
        Some(node) => body.whole_constraint(node),
        None => {
            body.sink.missing(section, "the invariant", "`:constraint`");
            None
        }
    };
    let (variables, span) = (body.schema.variables, section.span());
    Some(Invariant { name, variables, says, constraint: constraint?, span, name_span })
}

impl Body<'_> {
    /// A sentence: words between parentheses, and parameters.
    fn words(&mut self, node: Node<'_>) -> Vec<Word> {
        if !node.is_list() {
            self.sink.unexpected(node, "a sentence between parentheses, such as `(?p is never alone)`");
            return Vec::new();
        }
        let mut words = Vec::new();
        for part in node.children() {
            match part.kind() {
                NodeKind::Variable => words.extend(self.variable(part).map(Word::Variable)),
                NodeKind::List => self.sink.unexpected(part, "a word or a parameter"),
                NodeKind::Name | NodeKind::Number | NodeKind::Keyword => {
                    words.push(Word::Text(part.text().to_owned()));
                }
            }
        }
        words
    }
}

//! `(:action name :parameters (…) :precondition … :effect …)`.

use super::body::Body;
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::world::World;
use crate::Span;
use crate::analysis::NameKind;
use crate::diagnostic::UnsupportedFeature;
use crate::model::{Action, Condition, Effect, Name};
use crate::syntax::Node;

/// The name behind the section's keyword, and what follows. Reports a missing name.
pub(super) fn named<'t>(
    sink: &mut Sink,
    section: Node<'t>,
    kind: NameKind,
    what: &str,
) -> Option<(Name, Span, std::iter::Skip<crate::syntax::Children<'t>>)> {
    match section.children().nth(1) {
        Some(name) if name.is_name() => {
            sink.declare(kind, name, None);
            Some((Name::new(name.text()), name.span(), section.children().skip(2)))
        }
        Some(other) => {
            sink.unexpected(other, "a name");
            None
        }
        None => {
            sink.missing(section, what, "name");
            None
        }
    }
}

impl Body<'_> {
    /// `:parameters (…)`; none is like `()`.
    pub(super) fn parameters(&mut self, keys: &Keys<'_>) {
        match keys.get(":parameters") {
            Some(node) if node.is_list() => self.schema.parameters(self.world, self.sink, node.children()),
            Some(node) => self.sink.unexpected(node, "a list of variables such as `(?x - type)`"),
            None => {}
        }
    }

    /// The condition of a key; none always holds.
    pub(super) fn guard(&mut self, keys: &Keys<'_>, key: &str, section: Node<'_>) -> Condition {
        match keys.get(key) {
            Some(node) => self.condition(node),
            None => Condition::always(first_word(section)),
        }
    }
}

pub(crate) fn action(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Action> {
    let (name, name_span, rest) = named(sink, section, NameKind::Action, "the action")?;
    let keys = Keys::read(sink, rest, "an action", &[":parameters", ":vars", ":precondition", ":effect"]);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    if let (Some(key), Some(node)) = (keys.key(":vars"), keys.get(":vars")) {
        body.sink.unsupported(key.span(), UnsupportedFeature::ActionVariables);
        body.schema.parameters(world, body.sink, node.children());
    }
    let (precondition, preferences) = match keys.get(":precondition") {
        Some(node) => body.soft_condition(node),
        None => (Condition::always(first_word(section)), Vec::new()),
    };
    let effect = match keys.get(":effect") {
        Some(node) => body.effect(node),
        None => Effect::nothing(first_word(section)),
    };
    Some(Action {
        name,
        variables: body.schema.variables,
        precondition,
        preferences,
        effect,
        span: section.span(),
        name_span,
    })
}

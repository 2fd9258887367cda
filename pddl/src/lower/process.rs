//! PDDL+: `(:process …)` and `(:event …)`.
//!
//! Source: Fox & Long, "Modelling mixed discrete-continuous domains for planning", JAIR 2006.

use super::action::named;
use super::body::Body;
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::world::World;
use crate::model::{Effect, Event, Process};
use crate::occurrence::NameKind;
use crate::syntax::Node;

const KEYS: &[&str] = &[":parameters", ":precondition", ":effect"];

pub(crate) fn process(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Process> {
    let (name, name_span, rest) = named(sink, section, NameKind::Process, "the process")?;
    let keys = Keys::read(sink, rest, "a process", KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    let precondition = body.guard(&keys, ":precondition", section);
    let mut effects = Vec::new();
    if let Some(node) = keys.get(":effect") {
        body.only_continuous(node);
        effects = body.continuous_effects(node);
    }
    let (variables, span) = (body.schema.variables, section.span());
    Some(Process { name, variables, precondition, effects, span, name_span })
}

pub(crate) fn event(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Event> {
    let (name, name_span, rest) = named(sink, section, NameKind::Event, "the event")?;
    let keys = Keys::read(sink, rest, "an event", KEYS);
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters(&keys);
    let precondition = body.guard(&keys, ":precondition", section);
    let effect = match keys.get(":effect") {
        Some(node) => body.effect(node),
        None => Effect::nothing(first_word(section)),
    };
    let (variables, span) = (body.schema.variables, section.span());
    Some(Event { name, variables, precondition, effect, span, name_span })
}

impl Body<'_> {
    /// Reports an effect that is not continuous.
    fn only_continuous(&mut self, node: Node<'_>) {
        if node.is_headed("and") {
            for part in node.children().skip(1) {
                self.only_continuous(part);
            }
        } else if node.is_headed("forall") {
            match node.children().nth(2) {
                Some(body) => self.only_continuous(body),
                None => self.sink.missing(node, "the quantifier", "body"),
            }
        } else if !(self.is_continuous(node) || node.is_list() && node.head().is_none()) {
            self.sink.unexpected(node, "`(increase (FUNCTION …) (* #t RATE))`, or `decrease`");
        }
    }
}

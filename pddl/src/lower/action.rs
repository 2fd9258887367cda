//! `(:action name :parameters (…) :precondition … :effect …)`.
//!
//! The precondition binds the variables of PDDL 1.2's `:vars`. The model expresses this with existing forms:
//! the precondition is `(exists (?v) …)`, and the effect is that of each binding, `(forall (?v) (when …
//! …))`. Deviation: PDDL 1.2 does not define which of several bindings counts; here all of them do.
//!
//! In MA-PDDL's `:agent ?a - t` the agent is the first parameter.
//!
//! Source: Ghallab et al., "PDDL: the planning domain definition language", 1998; Kovacs, "A multi-agent extension of
//! PDDL3.1", 2012.

use super::body::Body;
use super::keys::Keys;
use super::sink::{Sink, first_word};
use super::typed_list::typed_list;
use super::world::World;
use crate::Span;
use crate::diagnostic::UnsupportedFeature;
use crate::model::{Action, Condition, ConditionKind, Effect, EffectKind, Name, Preference, VariableId};
use crate::occurrence::NameKind;
use crate::syntax::{Node, NodeKind};

/// The name behind the section's keyword, and the nodes after it. Reports a missing name.
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
    /// `:parameters (…)`; a missing key means `()`.
    pub(super) fn parameters(&mut self, keys: &Keys<'_>) {
        self.parameters_behind(&[], keys);
    }

    /// The same, appended to existing parameters.
    pub(super) fn parameters_behind(&mut self, first: &[Node<'_>], keys: &Keys<'_>) {
        let mut all = typed_list(self.sink, first.iter().copied());
        if let Some(node) = self.variable_list(keys, ":parameters") {
            all.extend(typed_list(self.sink, node.children()));
        }
        self.schema.bind_typed(self.world, self.sink, all);
        self.schema.variables.parameters = self.schema.variables.slots.len();
    }

    /// The list of variables behind a key; reports anything else.
    fn variable_list<'t>(&mut self, keys: &Keys<'t>, key: &str) -> Option<Node<'t>> {
        let node = keys.get(key)?;
        if !node.is_list() {
            self.sink.unexpected(node, "a list of variables such as `(?x - type)`");
        }
        Some(node).filter(|node| node.is_list())
    }

    /// Adds the variables that the precondition binds to precondition and effect.
    fn bound_by_precondition(&mut self, keys: &Keys<'_>, action: &mut Conditional) {
        let Some(variables) = self.variable_list(keys, ":vars") else { return };
        let span = variables.span();
        let precondition = keys.get(":precondition");
        let bind = |body: &mut Self| body.schema.bind(body.world, body.sink, variables.children());
        let hard = |body: &mut Self| match precondition {
            Some(node) => body.hard_condition(node),
            None => Condition::always(span),
        };
        let exists = |bound: Vec<VariableId>, inner: Condition| Condition {
            span: inner.span,
            kind: ConditionKind::Exists(bound, Box::new(inner)),
        };
        // Each quantifier of the model has its own slots, so its body is read once for each quantifier.
        let bound = bind(self);
        let inner = hard(self);
        self.schema.unbind(bound.len());
        action.precondition = exists(bound, inner);
        for found in precondition.map(|node| self.preferences_in(node)).unwrap_or_default() {
            let read = |body: &mut Self, node| {
                let bound = bind(body);
                let inner = body.condition(node);
                body.schema.unbind(bound.len());
                Some(exists(bound, inner))
            };
            action.preferences.extend(self.preference(&found, read));
        }
        if let Some(node) = keys.get(":effect") {
            let bound = bind(self);
            let when = hard(self);
            let effect = Box::new(self.effect(node));
            self.schema.unbind(bound.len());
            let when = Effect { kind: EffectKind::When(when, effect), span: node.span() };
            action.effect = Effect { kind: EffectKind::Forall(bound, Box::new(when)), span: node.span() };
        }
    }

    /// The condition of a key; a missing key means a condition that always holds.
    pub(super) fn guard(&mut self, keys: &Keys<'_>, key: &str, section: Node<'_>) -> Condition {
        match keys.get(key) {
            Some(node) => self.condition(node),
            None => Condition::always(first_word(section)),
        }
    }
}

const KEYS: &[&str] =
    &[":parameters", ":vars", ":precondition", ":effect", ":observe", ":expansion", ":only-in-expansions"];

/// Keys that are read but not modelled.
const OTHERS: &[(&str, UnsupportedFeature)] = &[
    (":observe", UnsupportedFeature::Observations),
    (":expansion", UnsupportedFeature::Expansions),
    (":only-in-expansions", UnsupportedFeature::Expansions),
];

/// The precondition and effect of an action.
struct Conditional {
    precondition: Condition,
    preferences: Vec<Preference<Condition>>,
    effect: Effect,
}

/// The words behind `:agent`, and everything else.
pub(super) fn agent<'t>(nodes: impl Iterator<Item = Node<'t>>) -> (Vec<Node<'t>>, Vec<Node<'t>>) {
    let (mut agent, mut rest) = (Vec::new(), Vec::new());
    let mut inside = false;
    for node in nodes {
        if node.kind() == NodeKind::Keyword {
            inside = node.is(":agent");
        }
        match inside {
            true if node.is(":agent") => {}
            true => agent.push(node),
            // `:expansion :methods` says that methods do it.
            false if node.is(":methods") => {}
            false => rest.push(node),
        }
    }
    (agent, rest)
}

pub(crate) fn action(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Action> {
    let (name, name_span, rest) = named(sink, section, NameKind::Action, "the action")?;
    let (agent, rest) = agent(rest);
    let keys = Keys::read(sink, rest.into_iter(), "an action", KEYS);
    for (key, feature) in OTHERS {
        if let Some(key) = keys.key(key) {
            sink.unsupported(key.span(), *feature);
        }
    }
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    body.parameters_behind(&agent, &keys);
    let mut conditional = Conditional {
        precondition: Condition::always(first_word(section)),
        preferences: Vec::new(),
        effect: Effect::nothing(first_word(section)),
    };
    if keys.key(":vars").is_some() {
        body.bound_by_precondition(&keys, &mut conditional);
    } else {
        if let Some(node) = keys.get(":precondition") {
            (conditional.precondition, conditional.preferences) = body.soft_condition(node);
        }
        if let Some(node) = keys.get(":effect") {
            conditional.effect = body.effect(node);
        }
    }
    let Conditional { precondition, preferences, effect } = conditional;
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

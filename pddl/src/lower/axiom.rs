//! `(:derived (p ?x - t) body)`, and PDDL 1.2's `(:axiom :vars (?x - t ?y) :context body :implies (p ?x))`.
//! Variables that `:implies` does not name are bound by `exists` in the body.
//!
//! A variable of the head without a type has the type that the predicate declares.

use super::body::{Applied, Body};
use super::keys::Keys;
use super::sink::Sink;
use super::typed_list::typed_list;
use super::world::World;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Axiom, Condition, ConditionKind, Predicate, PredicateId, TypeSet};
use crate::occurrence::NameKind;
use crate::syntax::Node;

/// The predicate that an axiom derives, if it is known; reports nothing.
pub(crate) fn derived_predicate(world: &World, section: Node<'_>) -> Option<PredicateId> {
    world.predicate(section.children().nth(1)?.head()?.text())
}

/// The predicate that an axiom of PDDL 1.2 derives, if it is known; reports nothing.
pub(crate) fn implied_predicate(world: &World, section: Node<'_>) -> Option<PredicateId> {
    let mut nodes = section.children().skip_while(|node| !node.is(":implies"));
    world.predicate(nodes.nth(1)?.head()?.text())
}

/// `(:axiom :vars (…) :context CONDITION :implies (p ?x …))`
pub(crate) fn implication(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Axiom> {
    let known = &[":vars", ":context", ":implies"];
    let keys = Keys::read(sink, section.children().skip(1), "an axiom", known);
    let Some(head) = keys.get(":implies") else {
        sink.missing(section, "the axiom", "`:implies`");
        return None;
    };
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    let id = body.derived(head)?;
    let mut others = match keys.get(":vars") {
        Some(node) => typed_list(body.sink, node.children()),
        None => Vec::new(),
    };
    let mut parameters = Vec::new();
    for argument in head.children().skip(1) {
        match others.iter().position(|(item, _)| item.is(argument.text())) {
            Some(index) => parameters.push(others.remove(index)),
            None => {
                body.sink.unexpected(argument, "a variable of `:vars` that does not stand here before");
                return None;
            }
        }
    }
    body.schema.bind_typed(world, body.sink, parameters);
    body.schema.variables.parameters = body.schema.variables.slots.len();
    body.head_fits(head, &of_predicate(world, id));
    let bound = body.schema.bind_typed(world, body.sink, others);
    let mut condition = body.guard(&keys, ":context", section);
    if !bound.is_empty() {
        let span = condition.span;
        condition = Condition { kind: ConditionKind::Exists(bound, Box::new(condition)), span };
    }
    let variables = body.schema.variables;
    Some(Axiom { predicate: id, variables, body: condition, span: section.span() })
}

pub(crate) fn axiom(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Axiom> {
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    let [head, condition] = body.parts(section, "`(:derived (PREDICATE ?x …) CONDITION)`")?;
    let id = body.derived(head)?;
    let faults = body.sink.count();
    body.schema.parameters(world, body.sink, head.children().skip(1));
    if body.sink.count() == faults {
        body.head_fits(head, &of_predicate(world, id));
    }
    let condition = body.condition(condition);
    Some(Axiom { predicate: id, variables: body.schema.variables, body: condition, span: section.span() })
}

fn of_predicate(world: &World, id: PredicateId) -> Applied<'_> {
    let Predicate { name, variables, .. } = &world.predicates[id];
    Applied { symbol: SymbolKind::Predicate, name, parameters: variables.parameters() }
}

impl Body<'_> {
    /// The predicate of an axiom's head.
    fn derived(&mut self, head: Node<'_>) -> Option<PredicateId> {
        let Some(symbol) = head.head().filter(|h| h.is_name()) else {
            self.sink.unexpected(head, "a predicate with its variables such as `(p ?x)`");
            return None;
        };
        let Some(id) = self.world.predicate(symbol.text()) else {
            self.world.unknown(self.sink, symbol, SymbolKind::Predicate);
            return None;
        };
        self.sink.mention(NameKind::Predicate, symbol, None);
        Some(id)
    }

    /// Compares the schema's parameters with those of the derived symbol, and takes missing types from there.
    pub(super) fn head_fits(&mut self, head: Node<'_>, of: &Applied<'_>) {
        let world = self.world;
        let found = self.schema.variables.parameters;
        self.count_fits(head, of, found);
        for (slot, parameter) in self.schema.variables.slots.iter_mut().zip(of.parameters) {
            if slot.types == TypeSet::any() {
                slot.types = parameter.types.clone();
            } else if !world.types.overlap(&slot.types, &parameter.types) {
                let kind = DiagnosticKind::NothingInCommon {
                    left: format!("?{}", slot.name),
                    left_type: world.type_text(&slot.types),
                    right: format!("?{}", parameter.name),
                    right_type: world.type_text(&parameter.types),
                };
                self.sink.report(slot.span, kind);
            }
        }
    }
}

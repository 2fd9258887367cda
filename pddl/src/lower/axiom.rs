//! `(:derived (p ?x - t) body)`.
//!
//! A head's variable without a type has the type that the predicate declares for it.

use super::body::Body;
use super::sink::Sink;
use super::world::World;
use crate::analysis::NameKind;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{Axiom, PredicateId, TypeSet};
use crate::syntax::Node;

/// The predicate that an axiom derives, if it is known; silent.
pub(crate) fn derived_predicate(world: &World, section: Node<'_>) -> Option<PredicateId> {
    world.predicate(section.children().nth(1)?.head()?.text())
}

pub(crate) fn axiom(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<Axiom> {
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    let [head, condition] = body.parts(section, "`(:derived (PREDICATE ?x …) CONDITION)`")?;
    let Some(symbol) = head.head().filter(|h| h.is_name()) else {
        body.sink.unexpected(head, "a predicate with its variables such as `(p ?x)`");
        return None;
    };
    let Some(id) = world.predicate(symbol.text()) else {
        world.unknown(body.sink, symbol, SymbolKind::Predicate);
        return None;
    };
    body.sink.mention(NameKind::Predicate, symbol, None);
    let predicate = &world.predicates[id];
    let parameters = predicate.variables.parameters();
    let faults = body.sink.count();
    body.schema.parameters(world, body.sink, head.children().skip(1));
    let found = body.schema.variables.parameters;
    if found != parameters.len() && body.sink.count() == faults {
        let kind = DiagnosticKind::WrongArity {
            symbol: SymbolKind::Predicate,
            name: predicate.name.clone(),
            expected: parameters.len(),
            found,
            signature: world.signature(&predicate.name, parameters),
        };
        body.sink.report(head.span(), kind);
    }
    for (slot, parameter) in body.schema.variables.slots.iter_mut().zip(parameters) {
        if slot.types == TypeSet::any() {
            slot.types = parameter.types.clone();
        } else if !world.meet(&slot.types, &parameter.types) {
            let kind = DiagnosticKind::NothingInCommon {
                left: format!("?{}", slot.name),
                left_type: world.type_text(&slot.types),
                right: format!("?{}", parameter.name),
                right_type: world.type_text(&parameter.types),
            };
            body.sink.report(slot.span, kind);
        }
    }
    let condition = body.condition(condition);
    Some(Axiom { predicate: id, variables: body.schema.variables, body: condition, span: section.span() })
}

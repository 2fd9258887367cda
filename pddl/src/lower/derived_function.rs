//! `(:derived (f ?x - t) VALUE)`: a numeric fluent that is computed from the state. The value is a numeric expression,
//! or `(count (?y - t) CONDITION)`, the number of bindings that satisfy the condition.
//!
//! Beyond PDDL: a mission's perception says in this way which numbers of the plan it senses. A name that is a predicate
//! is one, as everywhere.

use super::body::{Applied, Body};
use super::sink::Sink;
use super::world::World;
use crate::diagnostic::SymbolKind;
use crate::model::{DerivedFunction, DerivedValue, FunctionValue};
use crate::occurrence::NameKind;
use crate::syntax::Node;

/// Whether the section's head is a function and no predicate; reports nothing.
pub(crate) fn derives_function(world: &World, section: Node<'_>) -> bool {
    let name = section.children().nth(1).and_then(Node::head).map(Node::text);
    name.is_some_and(|name| world.predicate(name).is_none() && world.function(name).is_some())
}

pub(crate) fn derived_function(world: &World, sink: &mut Sink, section: Node<'_>) -> Option<DerivedFunction> {
    let mut body = Body::new(world, sink);
    body.schema.scope = section.span();
    let [head, value] = body.parts(section, "`(:derived (FUNCTION ?x …) VALUE)`")?;
    let symbol = head.head()?;
    let id = world.function(symbol.text())?;
    let function = &world.functions[id];
    body.sink.mention(NameKind::Function, symbol, None);
    if function.value != FunctionValue::Number {
        body.sink.unexpected(symbol, "a function whose values are numbers");
        return None;
    }
    let faults = body.sink.count();
    body.schema.parameters(world, body.sink, head.children().skip(1));
    if body.sink.count() == faults {
        let (name, parameters) = (&function.name, function.variables.parameters());
        body.head_fits(head, &Applied { symbol: SymbolKind::Function, name, parameters });
    }
    let value = if is_count(value) {
        let (bound, condition) = body.quantifier(value)?;
        let condition = body.condition(condition);
        body.schema.unbind(bound.len());
        DerivedValue::Count(bound, condition)
    } else {
        DerivedValue::Expression(body.expression(value)?)
    };
    Some(DerivedFunction { function: id, variables: body.schema.variables, value, span: section.span() })
}

/// `(count (…) …)`: the arguments of a function are no lists.
fn is_count(value: Node<'_>) -> bool {
    value.is_headed("count") && value.children().nth(1).is_some_and(Node::is_list)
}

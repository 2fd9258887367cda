//! `(:functions (f ?x - t) - number (g) - t …)`. Without a type a function yields a number.

use super::predicates::{Earlier, parameters, repeated, same_parameters};
use super::sink::Sink;
use super::typed_list::{public, typed_list, without_agent};
use super::world::World;
use crate::diagnostic::SymbolKind;
use crate::model::{Domain, Function, FunctionValue, Name};
use crate::occurrence::NameKind;
use crate::syntax::Node;

pub(crate) fn functions<'t>(
    world: &mut World,
    sink: &mut Sink,
    sections: impl Iterator<Item = Node<'t>>,
    imported: usize,
    imports: &[&Domain],
) {
    for section in sections {
        let parts = public(sink, section).into_iter().map(without_agent);
        let items: Vec<_> = parts.flat_map(|part| typed_list(sink, part.into_iter())).collect();
        for (node, value) in items {
            let head = if node.is_list() { node.head() } else { Some(node) };
            let Some(head) = head.filter(|h| h.is_name()) else {
                sink.unexpected(node, "a function such as `(f ?x - type)`");
                continue;
            };
            let value = match value {
                None => FunctionValue::Number,
                // Also if a type is called `number`: no function yields objects of that type.
                Some(t) if t.is("number") => FunctionValue::Number,
                Some(t) => FunctionValue::Object(world.type_set(sink, Some(t))),
            };
            let name = Name::new(head.text());
            sink.declare(NameKind::Function, head, None);
            let variables = parameters(world, sink, node);
            if let Some(first) = world.function(&name) {
                let declared = &world.functions[first];
                let same = declared.value == value && same_parameters(&declared.variables, &variables);
                let from = Earlier { span: declared.span, imported: (first.0 as usize) < imported };
                let import = imports.iter().find(|d| d.function(&name).is_some());
                repeated(sink, head.span(), SymbolKind::Function, name, same, from, import.copied());
                continue;
            }
            world.add_function(Function { name, variables, value, span: head.span() });
        }
    }
}

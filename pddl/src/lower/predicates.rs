//! `(:predicates (p ?x - t) …)`.

use super::schema::Schema;
use super::sink::Sink;
use super::typed_list::{public, without_agent};
use super::world::World;
use crate::Span;
use crate::diagnostic::{DiagnosticKind, Label, SymbolKind};
use crate::model::{Domain, Name, Predicate, TypeSet, Variables};
use crate::occurrence::NameKind;
use crate::syntax::Node;

pub(crate) fn predicates<'t>(
    world: &mut World,
    sink: &mut Sink,
    sections: impl Iterator<Item = Node<'t>>,
    imported: usize,
    imports: &[&Domain],
) {
    for section in sections {
        for node in public(sink, section).into_iter().flat_map(without_agent) {
            let Some(head) = node.head().filter(|h| h.is_name()) else {
                sink.unexpected(node, "a predicate such as `(p ?x - type)`");
                continue;
            };
            // Equality is built in; some old files declare it.
            if head.is("=") {
                continue;
            }
            let name = Name::new(head.text());
            sink.declare(NameKind::Predicate, head, None);
            let variables = parameters(world, sink, node);
            if let Some(first) = world.predicate(&name) {
                let declared = &world.predicates[first];
                let same = same_parameters(&declared.variables, &variables);
                let from = Earlier { span: declared.span, imported: (first.0 as usize) < imported };
                let import = imports.iter().find(|d| d.predicate(&name).is_some());
                repeated(sink, head.span(), SymbolKind::Predicate, name, same, from, import.copied());
                continue;
            }
            world.add_predicate(Predicate { name, variables, derived: false, span: head.span() });
        }
    }
}

/// The parameters of `(name ?x - t …)`.
pub(super) fn parameters(world: &World, sink: &mut Sink, node: Node<'_>) -> Variables {
    let mut schema = Schema::default();
    schema.scope = node.span();
    schema.parameters(world, sink, node.children().skip(1));
    schema.variables
}

/// Whether both have parameters of the same types (their names do not matter).
pub(super) fn same_parameters(a: &Variables, b: &Variables) -> bool {
    a.parameters == b.parameters
        && a.parameters().iter().zip(b.parameters()).all(|(x, y)| same_types(&x.types, &y.types))
}

/// Whether both unions name the same types.
fn same_types(a: &TypeSet, b: &TypeSet) -> bool {
    a.0.iter().all(|t| b.0.contains(t)) && b.0.iter().all(|t| a.0.contains(t))
}

/// An earlier declaration of a name.
#[derive(Clone, Copy)]
pub(super) struct Earlier {
    pub(super) span: Span,
    pub(super) imported: bool,
}

/// Reports a second declaration, unless it repeats an imported one.
pub(super) fn repeated(
    sink: &mut Sink,
    span: Span,
    symbol: SymbolKind,
    name: Name,
    same: bool,
    first: Earlier,
    import: Option<&Domain>,
) {
    match (same, import) {
        (true, _) if first.imported => {}
        (false, Some(domain)) if first.imported => {
            let import = domain.name.clone();
            sink.report(span, DiagnosticKind::ImportConflict { symbol, name, import });
        }
        (true, _) => {
            sink.report_with(span, DiagnosticKind::Redundant { symbol, name }, first.span, Label::First);
        }
        (false, _) => {
            sink.report_with(span, DiagnosticKind::Duplicate { symbol, name }, first.span, Label::First);
        }
    }
}

//! `a b - t c - (either t u) d`: items with their types.

use super::sink::Sink;
use super::world::World;
use crate::analysis::NameKind;
use crate::diagnostic::SymbolKind;
use crate::model::{TypeId, TypeSet};
use crate::syntax::Node;
use smallvec::SmallVec;

/// An item and the node of its type, if it has one.
pub(crate) type Typed<'t> = (Node<'t>, Option<Node<'t>>);

/// Splits a typed list. What the items and types are is the caller's to check.
pub(crate) fn typed_list<'t>(sink: &mut Sink, nodes: impl Iterator<Item = Node<'t>>) -> Vec<Typed<'t>> {
    let mut items: Vec<Typed<'t>> = Vec::new();
    let mut untyped = 0;
    let mut nodes = nodes.peekable();
    while let Some(node) = nodes.next() {
        if !node.is("-") {
            items.push((node, None));
            continue;
        }
        if untyped == items.len() {
            sink.unexpected(node, "a name before the hyphen");
        }
        match nodes.peek() {
            Some(next) if next.is_name() && !next.is("-") || next.is_list() => {
                let types = nodes.next();
                for item in &mut items[untyped..] {
                    item.1 = types;
                }
            }
            Some(next) => sink.unexpected(*next, "a type after the hyphen"),
            None => sink.missing(node, "the hyphen", "type"),
        }
        untyped = items.len();
    }
    items
}

/// The names that a type's node holds: itself, or those of `(either …)`.
pub(crate) fn type_names<'t>(sink: &mut Sink, node: Node<'t>) -> Vec<Node<'t>> {
    if node.is_name() {
        return vec![node];
    }
    if node.is_headed("either") {
        let names: Vec<_> = node.children().skip(1).collect();
        if !names.is_empty() && names.iter().all(|n| n.is_name()) {
            return names;
        }
    }
    sink.unexpected(node, "a type or `(either TYPE …)`");
    Vec::new()
}

impl World {
    /// The union that a type's node stands for; `object` where there is none.
    pub(crate) fn type_set(&self, sink: &mut Sink, node: Option<Node<'_>>) -> TypeSet {
        let Some(node) = node else { return TypeSet::any() };
        let mut types: SmallVec<[TypeId; 4]> = SmallVec::new();
        let mut unknown = false;
        for name in type_names(sink, node) {
            sink.mention(NameKind::Type, name, None);
            match self.type_id(name.text()) {
                Some(id) if !types.contains(&id) => types.push(id),
                Some(_) => {}
                None => {
                    unknown = true;
                    self.unknown(sink, name, SymbolKind::Type);
                }
            }
        }
        match types {
            // One mistake, one message: what has an unknown type fits everywhere.
            _ if unknown => TypeSet::unknown(),
            types if types.is_empty() => TypeSet::any(),
            types => TypeSet(types),
        }
    }
}

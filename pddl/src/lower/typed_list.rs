//! `a b - t c - (either t u) d`: items with their types.

use super::sink::{Sink, first_word};
use super::world::World;
use crate::diagnostic::{DiagnosticKind, SymbolKind};
use crate::model::{TypeId, TypeSet};
use crate::occurrence::NameKind;
use crate::syntax::Node;
use smallvec::SmallVec;

/// An item and the node of its type, if it has one.
pub(crate) type Typed<'t> = (Node<'t>, Option<Node<'t>>);

/// Splits a typed list. The caller checks the items and types.
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

/// The public items of a section, and the contents of each MA-PDDL `(:private …)` as a list of its own,
/// since no type reaches over its end. Warns that privacy is ignored.
///
/// Source: Komenda, Stolba & Kovacs, "The international competition of distributed and multiagent planners", 2016.
pub(crate) fn public<'t>(sink: &mut Sink, section: Node<'t>) -> Vec<Vec<Node<'t>>> {
    let (private, open): (Vec<Node<'t>>, Vec<Node<'t>>) =
        section.children().skip(1).partition(|node| node.is_headed(":private"));
    let mut parts = vec![open];
    for node in private {
        sink.report(first_word(node), DiagnosticKind::PrivacyIgnored);
        parts.push(node.children().skip(1).collect());
    }
    parts
}

/// Removes the agent that MA-PDDL names before private symbols, `?a - t (p) …`.
pub(crate) fn without_agent(mut nodes: Vec<Node<'_>>) -> Vec<Node<'_>> {
    if nodes.first().is_some_and(|first| !first.is_list() && !first.is_name()) {
        let agent = nodes.iter().position(|node| node.is_list()).unwrap_or(nodes.len());
        nodes.drain(..agent);
    }
    nodes
}

/// The names in the node of a type: itself, or those of `(either …)`.
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
    /// The union that the node of a type denotes; `object` if there is no node.
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
            // One mistake, one message: an unknown type fits everywhere.
            _ if unknown => TypeSet::unknown(),
            types if types.is_empty() => TypeSet::any(),
            types => TypeSet(types),
        }
    }
}

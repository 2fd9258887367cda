//! `(:constants …)` and `(:objects …)`.
//!
//! A name that is declared twice gives a warning: problems repeat their domain's constants, and in some
//! competition files an object has several types one after the other. The object then has all of them, as in
//! VAL. An imported constant may be repeated only with the same declaration.

use super::sink::Sink;
use super::typed_list::{public, typed_list};
use super::world::World;
use crate::diagnostic::{DiagnosticKind, Label, SymbolKind};
use crate::model::{Domain, IndexVec, Name, Object, ObjectId, ObjectTypes, Requirement};
use crate::occurrence::NameKind;
use crate::syntax::Node;

/// How many of the first objects come from other sources; their spans are not of this source.
#[derive(Clone, Copy)]
pub(crate) struct Foreign<'a> {
    pub(crate) count: usize,
    /// Whether a foreign object may be repeated without a warning.
    pub(crate) repeatable: bool,
    /// Where the foreign ones come from.
    pub(crate) imports: &'a [&'a Domain],
}

pub(crate) fn objects<'t>(
    world: &mut World,
    sink: &mut Sink,
    sections: impl Iterator<Item = Node<'t>>,
    foreign: Foreign<'_>,
) {
    for section in sections {
        let mut items = Vec::new();
        for (index, mut part) in public(sink, section).into_iter().enumerate() {
            // The first name in an unfactored file is the agent that owns these objects.
            if index > 0
                && world.has(Requirement::UnfactoredPrivacy)
                && part.get(1).is_some_and(|second| !second.is("-"))
            {
                part.remove(0);
            }
            items.extend(typed_list(sink, part.into_iter()));
        }
        // Consecutive items share their type's node: it is resolved once for all of them.
        let mut last: Option<(Option<crate::Span>, ObjectTypes)> = None;
        for (item, types) in items {
            let at = types.map(Node::span);
            let types = match last.take() {
                Some((place, set)) if place == at => set,
                _ => ObjectTypes::each_of(world.type_set(sink, types)),
            };
            last = Some((at, types.clone()));
            if item.is_name() {
                declare(world, sink, item, types, foreign);
            } else {
                sink.unexpected(item, "the name of an object");
            }
        }
    }
}

fn declare(world: &mut World, sink: &mut Sink, item: Node<'_>, types: ObjectTypes, foreign: Foreign<'_>) {
    let name = Name::new(item.text());
    sink.declare(NameKind::Object, item, None);
    let symbol = SymbolKind::Object;
    let Some(first) = world.object(&name) else {
        world.add_object(Object { name, types, span: item.span() });
        return;
    };
    let is_foreign = (first.0 as usize) < foreign.count;
    let same = world.objects[first].types == types;
    let import = foreign.imports.iter().find(|d| d.constant(&name).is_some()).map(|d| d.name.clone());
    let kind = match (same, import) {
        (true, _) if is_foreign && foreign.repeatable => return,
        (true, _) => DiagnosticKind::Redundant { symbol, name },
        (false, Some(import)) if is_foreign => DiagnosticKind::ImportConflict { symbol, name, import },
        (false, _) => {
            world.objects[first].types.extend(types);
            DiagnosticKind::SeveralTypes { name }
        }
    };
    if is_foreign {
        sink.report(item.span(), kind);
    } else {
        sink.report_with(item.span(), kind, world.objects[first].span, Label::First);
    }
}

/// The constants, in the order of their ids.
pub(crate) fn take(world: &mut World) -> IndexVec<ObjectId, Object> {
    std::mem::take(&mut world.objects)
}

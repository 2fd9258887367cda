//! Nodes that a scenario names.

use pddl::model::{ObjectId, PredicateId, TypeId};

use crate::layers::Layers;
use diagnostics::Finding;
use diagnostics::did_you_mean;
use diagnostics::toml::{Reader, Text};

/// A node of a type, by its name.
pub(super) fn node(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    ty: TypeId,
    kind: &str,
) -> Option<ObjectId> {
    find(reader, layers, text, kind, &|id| layers.is_a(id, ty))
}

/// A node of any type, by its name.
pub(super) fn any(reader: &mut Reader<'_>, layers: &Layers, text: &Text, kind: &str) -> Option<ObjectId> {
    find(reader, layers, text, kind, &|_| true)
}

/// A node that may stand as the `position`-th argument of a predicate.
pub(super) fn argument(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    predicate: PredicateId,
    position: usize,
    kind: &str,
) -> Option<ObjectId> {
    let parameter = layers.nodes.predicates[predicate].variables.parameters().get(position);
    let objects = &layers.graph.model.objects;
    let fits = |id| parameter.is_some_and(|p| objects[id].is_of(&p.types, &layers.nodes.types));
    find(reader, layers, text, kind, &fits)
}

fn find(
    reader: &mut Reader<'_>,
    layers: &Layers,
    text: &Text,
    kind: &str,
    fits: &dyn Fn(ObjectId) -> bool,
) -> Option<ObjectId> {
    let graph = &layers.graph.model;
    let found = graph.object(&text.value.to_ascii_lowercase()).filter(|&id| fits(id));
    if found.is_none() {
        let known: Vec<&str> = graph.objects.ids().filter(|&id| fits(id)).map(|id| layers.name(id)).collect();
        let help = did_you_mean(&text.value, known.iter().copied());
        let help = help.unwrap_or_else(|| format!("one of: {}", known.join(", ")));
        let message = format!("there is no {kind} `{}`", text.value);
        reader.findings.push(Finding::error("E0909", reader.place(text.span), message).help(help));
    }
    found
}

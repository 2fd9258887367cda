//! A state as plain text.

use dsr::Holder;

use crate::view::View;

/// A line for each node, and indented below it a line for each of its attributes, its place and its edges.
pub fn lines(view: &View<'_>) -> Vec<String> {
    let mut lines = Vec::new();
    for node in view.nodes() {
        lines.push(format!("{} ({})", node.name(), view.type_of(node)));
        let own = Holder::Node(node.id);
        let edges = node.edges().map(|edge| edge.key).filter(|key| view.contains(key.to));
        let place = view.snapshot.place_sentence(node.id);
        let said = view.snapshot.attribute_sentences(own).into_iter().chain(place);
        lines.extend(said.map(|line| format!("  {line}")));
        for key in edges {
            lines.extend(view.snapshot.sentence(key).map(|line| format!("  {line}")));
            let of = view.snapshot.attribute_sentences(Holder::Edge(key));
            lines.extend(of.into_iter().map(|line| format!("    {line}")));
        }
    }
    lines
}

//! A state in the language of graphviz.

use std::fmt::Write as _;

use dsr::Holder;

use crate::view::View;

/// Writes the view in the language of graphviz. Transforms are dashed.
pub fn dot(view: &View<'_>) -> String {
    let mut dot = String::from("digraph dsr {\n  node [shape=box];\n");
    let quoted = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
    for node in view.nodes() {
        let mut label = format!("{}\\n{}", quoted(node.name()), quoted(view.type_of(node)));
        for (name, value) in view.attributes(Holder::Node(node.id)) {
            let _ = write!(label, "\\n{}: {}", quoted(name), quoted(&value));
        }
        let _ = writeln!(dot, "  n{} [label=\"{label}\"];", node.id.index());
    }
    for key in view.edges() {
        let mut label = quoted(view.label(key));
        for (name, value) in view.attributes(Holder::Edge(key)) {
            let _ = write!(label, "\\n{}: {}", quoted(name), quoted(&value));
        }
        let _ = writeln!(dot, "  n{} -> n{} [label=\"{label}\"];", key.from.index(), key.to.index());
    }
    for (parent, child) in view.transforms() {
        let _ = writeln!(dot, "  n{} -> n{} [style=dashed, label=\"RT\"];", parent.index(), child.index());
    }
    dot.push_str("}\n");
    dot
}

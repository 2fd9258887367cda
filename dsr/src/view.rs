//! Looking at a state: all of it or what is around a node, as sentences, DOT, GraphML or SVG.
//!
//! Everything is text that is made from a snapshot and nothing else; the same state gives the same bytes. No program
//! such as graphviz is needed for the SVG: see [`svg`].

mod layers;
mod svg;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use crate::export::Export;
use crate::id::{EdgeKey, Holder, NodeId};
use crate::snapshot::{NodeView, Snapshot};
use crate::value::Value;

/// A part of a state.
#[derive(Debug, Clone)]
pub struct View<'s> {
    snapshot: &'s Snapshot,
    nodes: BTreeSet<NodeId>,
}

impl Snapshot {
    /// All of it.
    pub fn view(&self) -> View<'_> {
        View { snapshot: self, nodes: self.nodes().map(|node| node.id).collect() }
    }

    /// A node and what is at most so many edges or transforms away from it, whatever their direction.
    pub fn around(&self, node: NodeId, steps: usize) -> View<'_> {
        let mut nodes = BTreeSet::from([node]);
        let mut border = vec![node];
        for _ in 0..steps {
            if border.is_empty() {
                break;
            }
            let near = |id: &NodeId| self.get(*id).map(neighbours).unwrap_or_default();
            border = border.iter().flat_map(near).filter(|id| nodes.insert(*id)).collect();
        }
        View { snapshot: self, nodes }
    }
}

fn neighbours(node: NodeView<'_>) -> Vec<NodeId> {
    let ends = node.edges().map(|edge| edge.key.to);
    let starts = node.incoming().map(|key| key.from);
    let parent = node.parent().map(|(parent, ..)| parent);
    ends.chain(starts).chain(parent).chain(node.children().iter().copied()).collect()
}

impl<'s> View<'s> {
    /// The nodes, by id.
    pub fn nodes(&self) -> impl Iterator<Item = NodeView<'s>> + '_ {
        self.nodes.iter().filter_map(|id| self.snapshot.get(*id))
    }

    /// The edges between them, by start, label and end.
    pub fn edges(&self) -> impl Iterator<Item = EdgeKey> + '_ {
        let edges = self.nodes().flat_map(|node| node.edges());
        edges.map(|edge| edge.key).filter(|key| self.nodes.contains(&key.to))
    }

    /// The transforms between them: parent and child.
    fn transforms(&self) -> impl Iterator<Item = (NodeId, NodeId)> + '_ {
        let hung = self.nodes().filter_map(|node| Some((node.parent()?.0, node.id)));
        hung.filter(|(parent, _)| self.nodes.contains(parent))
    }

    fn name(&self, id: NodeId) -> &'s str {
        self.snapshot.name(id).unwrap_or("")
    }

    fn type_of(&self, node: NodeView<'_>) -> &'s str {
        self.snapshot.vocabulary().type_name(node.node_type()).map_or("", |name| name)
    }

    fn label(&self, key: EdgeKey) -> &'s str {
        self.snapshot.vocabulary().label_name(key.label).map_or("", |name| name)
    }

    fn attributes(&self, holder: Holder) -> Vec<(&'s str, String)> {
        let views: Vec<_> = match holder {
            Holder::Node(id) => self.snapshot.get(id).map_or(Vec::new(), |node| node.attributes().collect()),
            Holder::Edge(EdgeKey { from, label, to }) => {
                let edge = self.snapshot.edge(from, label, to);
                edge.map_or(Vec::new(), |edge| edge.attributes().collect())
            }
        };
        let shown = views.into_iter().map(|view| {
            let name = self.snapshot.vocabulary().attribute_name(view.attribute).map_or("", |name| name);
            let value = match view.value {
                Value::Number(number) => number.to_string(),
                Value::Text(text) => text.to_string(),
                Value::Bool(truth) => truth.to_string(),
                Value::Node(node) => self.name(*node).to_owned(),
            };
            (name, value)
        });
        shown.collect()
    }

    /// Each node in a line, and below it what is said of it.
    pub fn lines(&self) -> Vec<String> {
        let mut lines = Vec::new();
        for node in self.nodes() {
            lines.push(format!("{} ({})", node.name(), self.type_of(node)));
            let own = Holder::Node(node.id);
            let edges = node.edges().map(|edge| edge.key).filter(|key| self.nodes.contains(&key.to));
            let place = self.snapshot.place_sentence(node.id);
            let said = self.snapshot.attribute_sentences(own).into_iter().chain(place);
            lines.extend(said.map(|line| format!("  {line}")));
            for key in edges {
                lines.extend(self.snapshot.sentence(key).map(|line| format!("  {line}")));
                let of = self.snapshot.attribute_sentences(Holder::Edge(key));
                lines.extend(of.into_iter().map(|line| format!("    {line}")));
            }
        }
        lines
    }

    /// As plain data.
    pub fn export(&self) -> Export {
        let mut export = self.snapshot.export();
        let inside = |name: &str| self.snapshot.node(name).is_some_and(|id| self.nodes.contains(&id));
        export.nodes.retain(|node| self.nodes.contains(&node.id));
        export.edges.retain(|edge| inside(&edge.from) && inside(&edge.to));
        export.transforms.retain(|transform| inside(&transform.parent) && inside(&transform.child));
        export
    }

    /// In the language of graphviz. Transforms are dashed.
    pub fn dot(&self) -> String {
        let mut dot = String::from("digraph dsr {\n  node [shape=box];\n");
        let quoted = |text: &str| text.replace('\\', "\\\\").replace('"', "\\\"");
        for node in self.nodes() {
            let mut label = format!("{}\\n{}", quoted(node.name()), quoted(self.type_of(node)));
            for (name, value) in self.attributes(Holder::Node(node.id)) {
                let _ = write!(label, "\\n{}: {}", quoted(name), quoted(&value));
            }
            let _ = writeln!(dot, "  n{} [label=\"{label}\"];", node.id.index());
        }
        for key in self.edges() {
            let mut label = quoted(self.label(key));
            for (name, value) in self.attributes(Holder::Edge(key)) {
                let _ = write!(label, "\\n{}: {}", quoted(name), quoted(&value));
            }
            let _ = writeln!(dot, "  n{} -> n{} [label=\"{label}\"];", key.from.index(), key.to.index());
        }
        for (parent, child) in self.transforms() {
            let _ =
                writeln!(dot, "  n{} -> n{} [style=dashed, label=\"RT\"];", parent.index(), child.index());
        }
        dot.push_str("}\n");
        dot
    }

    /// As GraphML, with every attribute as a string and poses as seven numbers: translation x y z, quaternion i j k w; a
    /// covariance is six rows of six.
    pub fn graphml(&self) -> String {
        // Names of attributes may be anything, ids of keys not.
        let mut keys: BTreeMap<(&'static str, String), usize> = BTreeMap::new();
        let mut body = String::new();
        let mut data = |body: &mut String, on: &'static str, name: &str, value: &str| {
            let next = keys.len();
            let key = *keys.entry((on, name.to_owned())).or_insert(next);
            let _ = writeln!(body, "      <data key=\"k{key}\">{}</data>", escaped(value));
        };
        for node in self.nodes() {
            let _ = writeln!(body, "    <node id=\"n{}\">", node.id.index());
            data(&mut body, "node", "name", node.name());
            data(&mut body, "node", "type", self.type_of(node));
            for (name, value) in self.attributes(Holder::Node(node.id)) {
                data(&mut body, "node", &format!("attribute.{name}"), &value);
            }
            body.push_str("    </node>\n");
        }
        let open = |body: &mut String, from: NodeId, to: NodeId| {
            let _ = writeln!(body, "    <edge source=\"n{}\" target=\"n{}\">", from.index(), to.index());
        };
        for key in self.edges() {
            open(&mut body, key.from, key.to);
            data(&mut body, "edge", "label", self.label(key));
            for (name, value) in self.attributes(Holder::Edge(key)) {
                data(&mut body, "edge", &format!("attribute.{name}"), &value);
            }
            body.push_str("    </edge>\n");
        }
        for (parent, child) in self.transforms() {
            open(&mut body, parent, child);
            data(&mut body, "edge", "label", "RT");
            if let Some((_, pose, _)) = self.snapshot.get(child).and_then(|node| node.parent()) {
                let (place, turn) = (&pose.transform.translation.vector, &pose.transform.rotation.coords);
                data(&mut body, "edge", "pose", &numbers(place.iter().chain(turn)));
                if let Some(covariance) = &pose.covariance {
                    let rows = covariance.matrix().row_iter();
                    let rows: Vec<_> = rows.map(|row| numbers(row.iter())).collect();
                    data(&mut body, "edge", "covariance", &rows.join(" "));
                }
            }
            body.push_str("    </edge>\n");
        }
        let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        xml.push_str("<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
        for ((on, name), key) in keys {
            let name = escaped(&name);
            let _ = writeln!(
                xml,
                "  <key id=\"k{key}\" for=\"{on}\" attr.name=\"{name}\" attr.type=\"string\"/>"
            );
        }
        let _ = writeln!(xml, "  <graph id=\"dsr\" edgedefault=\"directed\">\n{body}  </graph>\n</graphml>");
        xml
    }

    /// As a picture.
    pub fn svg(&self) -> String {
        svg::draw(self)
    }
}

fn numbers<'n>(numbers: impl Iterator<Item = &'n f64>) -> String {
    numbers.map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

/// Text in XML.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            // Readers take these for blanks, or for ends of lines of their own.
            '\t' | '\n' | '\r' => _ = write!(escaped, "&#{};", u32::from(c)),
            // XML 1.0 has no way to write these. Source: "Extensible Markup Language (XML) 1.0", W3C, 2008, §2.2.
            '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c if c < ' ' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

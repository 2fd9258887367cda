//! A state as GraphML.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use dsr::{Holder, NodeId};

use crate::view::View;
use crate::xml::escaped;

/// Writes the view as GraphML. Every attribute is a string. A pose is seven numbers: translation x y z, quaternion i j
/// k w. A covariance is its six rows, one after the other.
pub fn graphml(view: &View<'_>) -> String {
    // An attribute may have any name, but the id of a GraphML key must be an XML name token.
    let mut keys: BTreeMap<(&'static str, String), usize> = BTreeMap::new();
    let mut body = String::new();
    let mut data = |body: &mut String, on: &'static str, name: &str, value: &str| {
        let next = keys.len();
        let key = *keys.entry((on, name.to_owned())).or_insert(next);
        let _ = writeln!(body, "      <data key=\"k{key}\">{}</data>", escaped(value));
    };
    for node in view.nodes() {
        let _ = writeln!(body, "    <node id=\"n{}\">", node.id.index());
        data(&mut body, "node", "name", node.name());
        data(&mut body, "node", "type", view.type_of(node));
        for (name, value) in view.attributes(Holder::Node(node.id)) {
            data(&mut body, "node", &format!("attribute.{name}"), &value);
        }
        body.push_str("    </node>\n");
    }
    let open = |body: &mut String, from: NodeId, to: NodeId| {
        let _ = writeln!(body, "    <edge source=\"n{}\" target=\"n{}\">", from.index(), to.index());
    };
    for key in view.edges() {
        open(&mut body, key.from, key.to);
        data(&mut body, "edge", "label", view.label(key));
        for (name, value) in view.attributes(Holder::Edge(key)) {
            data(&mut body, "edge", &format!("attribute.{name}"), &value);
        }
        body.push_str("    </edge>\n");
    }
    for (parent, child) in view.transforms() {
        open(&mut body, parent, child);
        data(&mut body, "edge", "label", "RT");
        if let Some((_, pose, _)) = view.snapshot.get(child).and_then(|node| node.parent()) {
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
        let _ =
            writeln!(xml, "  <key id=\"k{key}\" for=\"{on}\" attr.name=\"{name}\" attr.type=\"string\"/>");
    }
    let _ = writeln!(xml, "  <graph id=\"dsr\" edgedefault=\"directed\">\n{body}  </graph>\n</graphml>");
    xml
}

fn numbers<'n>(numbers: impl Iterator<Item = &'n f64>) -> String {
    numbers.map(ToString::to_string).collect::<Vec<_>>().join(" ")
}

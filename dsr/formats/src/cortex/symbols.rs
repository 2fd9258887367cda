//! The symbols and links of a file, with references resolved.

use std::collections::{BTreeMap, BTreeSet};

use dsr::NewValue;

use super::error::CortexError;
use super::file::{self, Model};
use super::names::Names;
use super::ring::{self, CortexUnit, Placed};

/// An attribute value of the file.
pub(super) struct Found {
    pub(super) name: String,
    /// Its position, if it is in a list.
    pub(super) at: Option<usize>,
    pub(super) value: NewValue,
}

/// A symbol, with the type that the file gives it.
pub(super) struct Node {
    pub(super) name: String,
    pub(super) kind: String,
    pub(super) values: Vec<Found>,
}

/// A link between two nodes that is not a transform, with the label that the file gives it.
pub(super) struct Edge {
    pub(super) from: usize,
    pub(super) label: String,
    pub(super) to: usize,
    pub(super) values: Vec<Found>,
}

/// An `RT` link.
pub(super) struct Joint {
    pub(super) parent: usize,
    pub(super) child: usize,
    pub(super) placed: Placed,
}

/// The symbols as nodes, and the position of each by its id.
pub(super) fn nodes(
    model: &Model,
    names: &mut Names,
    notes: &mut Vec<String>,
) -> Result<(Vec<Node>, BTreeMap<String, usize>), CortexError> {
    let (mut nodes, mut ids) = (Vec::new(), BTreeMap::new());
    for symbol in model.symbols.values() {
        let (id, kind) = (symbol.id.text(), symbol.kind.clone());
        let own = if symbol.name.is_empty() { format!("{kind}_{id}") } else { symbol.name.clone() };
        let name = names.give(&own, notes);
        let values = gather(&name, &symbol.attribute, notes);
        if ids.insert(id.clone(), nodes.len()).is_some() {
            return Err(CortexError::SameId { id });
        }
        nodes.push(Node { name, kind, values });
    }
    Ok((nodes, ids))
}

/// The links between `nodes`: those that carry a label, and those that carry a transform.
pub(super) fn links(
    model: &Model,
    nodes: &[Node],
    ids: &BTreeMap<String, usize>,
    unit: CortexUnit,
    notes: &mut Vec<String>,
) -> Result<(Vec<Edge>, Vec<Joint>), CortexError> {
    let (mut edges, mut joints) = (Vec::new(), Vec::new());
    let (mut seen, mut hung) = (BTreeSet::new(), BTreeSet::new());
    for link in model.symbols.values().flat_map(|symbol| &symbol.links) {
        let (src, dst, label) = (link.src.text(), link.dst.text(), link.label.clone());
        // Cortex skips these with a warning, too.
        let (Some(&from), Some(&to)) = (ids.get(&src), ids.get(&dst)) else {
            let missing = if ids.contains_key(&src) { &dst } else { &src };
            notes.push(format!(
                "link `{label}` from {src} to {dst}: left out, no symbol has the id {missing}"
            ));
            continue;
        };
        let (start, end) = (&nodes[from].name, &nodes[to].name);
        if label == "RT" {
            if !hung.insert((from, to)) {
                notes.push(format!("link `RT` from `{start}` to `{end}`: left out, there is one already"));
                continue;
            }
            let no_pose = || CortexError::NoPose { parent: start.clone(), child: end.clone() };
            let placed = ring::placed(link, unit).ok_or_else(no_pose)?;
            joints.push(Joint { parent: from, child: to, placed });
            for name in link.attribute.keys().filter(|name| !ring::NAMES.contains(&name.as_str())) {
                notes.push(format!(
                    "attribute `{name}` of `{start} RT {end}`: left out, a transform has none"
                ));
            }
        } else if from == to {
            notes.push(format!("link `{label}` from `{start}` to itself: left out, no edge may do that"));
        } else if !seen.insert((from, label.clone(), to)) {
            notes.push(format!("link `{label}` from `{start}` to `{end}`: left out, there is one already"));
        } else {
            let values = gather(&format!("{start} {label} {end}"), &link.attribute, notes);
            edges.push(Edge { from, label, to, values });
        }
    }
    Ok((edges, joints))
}

fn gather(holder: &str, contents: &file::Attributes, notes: &mut Vec<String>) -> Vec<Found> {
    let mut found = Vec::new();
    for (name, content) in contents {
        match content.values() {
            Ok(values) => {
                let values = values.into_iter();
                found.extend(values.map(|(at, value)| Found { name: name.clone(), at, value }));
            }
            Err(reason) => notes.push(format!("attribute `{name}` of `{holder}`: left out, {reason}")),
        }
    }
    found
}

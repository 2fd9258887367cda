//! Worlds of RoboComp's cortex as graphs of ours: its JSON files with `DSRModel` and `symbols`.
//!
//! Problem: their types, labels and attributes are whatever the file has; ours are declared. Idea: the vocabulary is what
//! the file uses. Node types stand below `object`, geometric where an `RT` link touches one; a label goes between the
//! types that it goes between; an attribute sits on the one type that has it, or on `object`. Lists of numbers become
//! one attribute each (`size_0`, `size_1` …), since our attributes hold one value. An `RT` link is a transform: translation
//! in the file's unit, rotation by the angles about x, y and z as `Rx · Ry · Rz`. Where it keeps a ring of stamped poses,
//! those of the last ten seconds are samples, at the Unix times of their stamps; a single one is a transform that stays.
//! What cannot be taken, and what is called otherwise because the name is taken, is in the notes, with the reason.
//!
//! Invariant: no file is refused for its names.
//!
//! Source: the format as cortex's `api/dsr_utils.cpp` reads it and `api/dsr_rt_api.cpp` means it.

mod attributes;
mod file;
mod names;
mod ring;

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use self::attributes::{Attributes, Found};
use self::file::Model;
use self::names::Names;
use self::ring::Placed;
use crate::graph::Graph;
use crate::id::{AgentId, LabelId, Time, TypeId};
use crate::transaction::{HolderRef, Transaction, TransactionError};
use crate::vocabulary::{Nature, Vocabulary, VocabularyBuilder, VocabularyError};

/// A file of cortex.
#[derive(Debug, Clone, Deserialize, Serialize)]
pub struct CortexWorld {
    #[serde(rename = "DSRModel")]
    model: Model,
}

/// The unit of the file's translations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CortexUnit {
    /// RoboComp's own.
    #[default]
    Millimetres,
    /// Some files'.
    Metres,
}

/// A world that was taken over.
#[derive(Debug)]
pub struct Imported {
    /// The graph, at version 1.
    pub graph: Graph,
    /// What was left out or renamed, and why.
    pub notes: Vec<String>,
}

/// Why a file is no world of ours.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum CortexError {
    /// Two symbols with one id.
    #[error("two symbols have the id {id}")]
    SameId { id: String },
    /// An RT link without three numbers each.
    #[error("link `RT` from `{parent}` to `{child}` has no translation and rotation of three numbers")]
    NoPose { parent: String, child: String },
    /// Tokens that no vocabulary has.
    #[error(transparent)]
    Vocabulary(#[from] VocabularyError),
    /// Not a graph that keeps the invariants: a second root, a cycle, a second parent.
    #[error(transparent)]
    Transaction(#[from] TransactionError),
}

/// Who writes in a world that was taken over.
const AGENT: &str = "cortex";

/// A symbol, by the type that the file gives it.
struct Node {
    name: String,
    kind: String,
    values: Vec<Found>,
}

/// A link that is no transform, between two of the nodes, by the label that the file gives it.
struct Edge {
    from: usize,
    label: String,
    to: usize,
    values: Vec<Found>,
}

/// Where the child of an `RT` link is.
struct Joint {
    parent: usize,
    child: usize,
    placed: Placed,
}

/// The names that every graph has, and those that are given out.
struct Spaces {
    nodes: Names,
    types: Names,
    labels: Names,
    attributes: Names,
}

impl Spaces {
    fn new() -> Self {
        let own = VocabularyBuilder::new().build();
        let own: &Vocabulary = &own;
        let agents = own.agents().filter_map(|id| own.agent_name(id)).map(ToString::to_string);
        Self {
            // Our agents are nodes, too.
            nodes: Names::new("node", agents.chain([AGENT.to_owned()])),
            types: Names::new("type", own.types().filter_map(|id| own.type_name(id))),
            labels: Names::new("label", own.labels().filter_map(|id| own.label_name(id))),
            attributes: Names::new("attribute", own.attributes().filter_map(|id| own.attribute_name(id))),
        }
    }
}

/// What the file's types and labels have become.
#[derive(Default)]
struct Kinds {
    types: BTreeMap<String, TypeId>,
    labels: BTreeMap<String, LabelId>,
    label_names: BTreeMap<String, String>,
}

impl Kinds {
    fn declare(
        builder: &mut VocabularyBuilder,
        (nodes, edges, joints): (&[Node], &[Edge], &[Joint]),
        names: &mut Spaces,
        notes: &mut Vec<String>,
    ) -> Result<Self, CortexError> {
        let mut kinds = Self::default();
        let touched = joints.iter().flat_map(|joint| [joint.parent, joint.child]);
        let geometric: BTreeSet<_> = touched.map(|at| nodes[at].kind.as_str()).collect();
        for node in nodes {
            if !kinds.types.contains_key(&node.kind) {
                let nature = match geometric.contains(node.kind.as_str()) {
                    true => Nature::Geometric,
                    false => Nature::Symbolic,
                };
                let id = builder.node_type(&names.types.give(&node.kind, notes), None, nature)?;
                kinds.types.insert(node.kind.clone(), id);
            }
        }
        for edge in edges {
            if !kinds.label_names.contains_key(&edge.label) {
                kinds.label_names.insert(edge.label.clone(), names.labels.give(&edge.label, notes));
            }
            let [from, to] = [edge.from, edge.to].map(|at| kinds.types[&nodes[at].kind]);
            let id = builder.label(&kinds.label_names[&edge.label], from, to)?;
            kinds.labels.insert(edge.label.clone(), id);
        }
        Ok(kinds)
    }
}

impl CortexWorld {
    /// The graph of the file.
    pub fn import(&self, unit: CortexUnit) -> Result<Imported, CortexError> {
        let (mut notes, mut names) = (Vec::new(), Spaces::new());
        let (nodes, ids) = self.nodes(&mut names.nodes, &mut notes)?;
        let (edges, joints) = self.links(&nodes, &ids, unit, &mut notes)?;

        let mut builder = VocabularyBuilder::new();
        let kinds = Kinds::declare(&mut builder, (&nodes, &edges, &joints), &mut names, &mut notes)?;
        let used = (&*nodes, &*edges);
        let attributes = Attributes::declare(&mut builder, used, &kinds, &mut names.attributes, &mut notes)?;
        builder.agent(AGENT)?;

        let graph = Graph::new(builder.build());
        let mut tx = Transaction::new(AgentId::DSR);
        let name = |at: usize| nodes[at].name.as_str();
        for node in &nodes {
            tx.add_node(node.name.as_str(), kinds.types[&node.kind]);
        }
        for Joint { parent, child, placed } in &joints {
            match placed {
                Placed::Still(pose) => _ = tx.set_transform(name(*parent), name(*child), *pose),
                Placed::Moves(moves) => {
                    for (time, pose) in moves {
                        tx.sample_transform(name(*parent), name(*child), *time, *pose);
                    }
                }
            }
        }
        for edge in &edges {
            let (from, label, to) = (name(edge.from), kinds.labels[&edge.label], name(edge.to));
            tx.add_edge(from, label, to);
            for found in &edge.values {
                if let Some(attribute) = attributes.on_edge(&edge.label, found) {
                    tx.set_attribute(HolderRef::edge(from, label, to), attribute, found.value.clone());
                }
            }
        }
        for node in &nodes {
            for found in &node.values {
                if let Some(attribute) = attributes.on_node(found) {
                    tx.set_attribute(node.name.as_str(), attribute, found.value.clone());
                }
            }
        }
        graph.commit(&tx, Time(0))?;
        Ok(Imported { graph, notes })
    }

    fn nodes(
        &self,
        names: &mut Names,
        notes: &mut Vec<String>,
    ) -> Result<(Vec<Node>, BTreeMap<String, usize>), CortexError> {
        let (mut nodes, mut ids) = (Vec::new(), BTreeMap::new());
        for symbol in self.model.symbols.values() {
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

    fn links(
        &self,
        nodes: &[Node],
        ids: &BTreeMap<String, usize>,
        unit: CortexUnit,
        notes: &mut Vec<String>,
    ) -> Result<(Vec<Edge>, Vec<Joint>), CortexError> {
        let (mut edges, mut joints) = (Vec::new(), Vec::new());
        let (mut seen, mut hung) = (BTreeSet::new(), BTreeSet::new());
        for link in self.model.symbols.values().flat_map(|symbol| &symbol.links) {
            let (src, dst, label) = (link.src.text(), link.dst.text(), link.label.clone());
            // Cortex passes over these with a warning, too.
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
                    notes
                        .push(format!("link `RT` from `{start}` to `{end}`: left out, there is one already"));
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
                notes.push(format!(
                    "link `{label}` from `{start}` to `{end}`: left out, there is one already"
                ));
            } else {
                let values = gather(&format!("{start} {label} {end}"), &link.attribute, notes);
                edges.push(Edge { from, label, to, values });
            }
        }
        Ok((edges, joints))
    }
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

//! Worlds of RoboComp's cortex as graphs: its JSON files with `DSRModel` and `symbols`.
//!
//! Problem: a file of cortex uses any types, labels and attributes; a graph has a declared vocabulary. Idea: declare
//! what the file uses. Node types are below `object`, and geometric if an `RT` link touches a node of the type. A label
//! connects the types that it connects in the file. An attribute belongs to the one type that has it, or to `object`. A
//! list of numbers becomes one attribute per number (`size_0`, `size_1` …), since an attribute holds one value. An `RT`
//! link is a transform: its translation is in the file's unit, its rotation the angles about x, y and z as `Rx · Ry ·
//! Rz`. If the link keeps a ring of stamped poses, those of the last ten seconds become samples at the Unix times of
//! their stamps; a single pose is a static transform. The notes list what is left out or renamed, with the reason.
//!
//! Invariant: no file is rejected for its names.
//!
//! Source: the format as cortex's `api/dsr_utils.cpp` reads it and `api/dsr_rt_api.cpp` uses it.

mod attributes;
mod error;
mod file;
mod kinds;
mod names;
mod ring;
mod symbols;

use dsr::{AgentId, Graph, HolderRef, Time, Transaction, VocabularyBuilder};
use serde::{Deserialize, Serialize};

pub use self::error::CortexError;
pub use self::ring::CortexUnit;

use self::attributes::Attributes;
use self::file::Model;
use self::kinds::{AGENT, Kinds, Spaces};
use self::ring::Placed;
use self::symbols::Joint;

/// A file of cortex.
#[derive(Debug, Clone, Deserialize, Serialize)]
pub struct CortexWorld {
    #[serde(rename = "DSRModel")]
    model: Model,
}

/// The graph of a file, with notes.
#[derive(Debug)]
pub struct Imported {
    /// The graph, at version 1.
    pub graph: Graph,
    /// What was left out or renamed, with the reason.
    pub notes: Vec<String>,
}

impl CortexWorld {
    /// Builds the graph of the file.
    pub fn import(&self, unit: CortexUnit) -> Result<Imported, CortexError> {
        let (mut notes, mut names) = (Vec::new(), Spaces::new());
        let (nodes, ids) = symbols::nodes(&self.model, &mut names.nodes, &mut notes)?;
        let (edges, joints) = symbols::links(&self.model, &nodes, &ids, unit, &mut notes)?;

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
}

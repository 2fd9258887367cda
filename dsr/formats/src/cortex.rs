//! Worlds of RoboComp's cortex as graphs of ours: its JSON files with `DSRModel` and `symbols`.
//!
//! Problem: their types, labels and attributes are whatever the file has; ours are declared. Idea: the vocabulary is
//! what the file uses. Node types stand below `object`, geometric where an `RT` link touches one; a label goes between
//! the types that it goes between; an attribute sits on the one type that has it, or on `object`. Lists of numbers
//! become one attribute each (`size_0`, `size_1` …), since our attributes hold one value. An `RT` link is a transform:
//! translation in the file's unit, rotation by the angles about x, y and z as `Rx · Ry · Rz`. Where it keeps a ring of
//! stamped poses, those of the last ten seconds are samples, at the Unix times of their stamps; a single one is a
//! transform that stays. What cannot be taken, and what is called otherwise because the name is taken, is in the notes,
//! with the reason.
//!
//! Invariant: no file is refused for its names.
//!
//! Source: the format as cortex's `api/dsr_utils.cpp` reads it and `api/dsr_rt_api.cpp` means it.

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

/// A world that was taken over.
#[derive(Debug)]
pub struct Imported {
    /// The graph, at version 1.
    pub graph: Graph,
    /// What was left out or renamed, and why.
    pub notes: Vec<String>,
}

impl CortexWorld {
    /// The graph of the file.
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

//! The types and labels of the file as types and labels of a vocabulary.

use std::collections::{BTreeMap, BTreeSet};

use dsr::{LabelId, Nature, TypeId, Vocabulary, VocabularyBuilder};

use super::error::CortexError;
use super::names::Names;
use super::symbols::{Edge, Joint, Node};

/// The agent that writes in an imported world.
pub(super) const AGENT: &str = "cortex";

/// The names that are taken: those that every graph has, and those given so far.
pub(super) struct Spaces {
    pub(super) nodes: Names,
    pub(super) types: Names,
    pub(super) labels: Names,
    pub(super) attributes: Names,
}

impl Spaces {
    pub(super) fn new() -> Self {
        let own = VocabularyBuilder::new().build();
        let own: &Vocabulary = &own;
        let agents = own.agents().filter_map(|id| own.agent_name(id)).map(ToString::to_string);
        Self {
            // Agents are nodes, too.
            nodes: Names::new("node", agents.chain([AGENT.to_owned()])),
            types: Names::new("type", own.types().filter_map(|id| own.type_name(id))),
            labels: Names::new("label", own.labels().filter_map(|id| own.label_name(id))),
            attributes: Names::new("attribute", own.attributes().filter_map(|id| own.attribute_name(id))),
        }
    }
}

/// The ids of the file's types and labels.
#[derive(Default)]
pub(super) struct Kinds {
    pub(super) types: BTreeMap<String, TypeId>,
    pub(super) labels: BTreeMap<String, LabelId>,
    pub(super) label_names: BTreeMap<String, String>,
}

impl Kinds {
    pub(super) fn declare(
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

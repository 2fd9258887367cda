//! What a commit changed: the difference between two states, never the list of what was asked.
//!
//! Problem: a log of requested edits says "added" for what was there and "removed" for what was put back a line
//! later. Idea: compare, node by node, what the transaction touched with what was there before. What is the same
//! to the bit keeps its old `since`; the rest is a change. Invariant: applying the changes in their order to the
//! state before gives the state after, to the byte (see `replay`). Cost: linear in the content of touched nodes.

use std::sync::Arc;

use nalgebra::Isometry3;
use serde::{Deserialize, Serialize};

use crate::id::{AgentId, AttributeId, EdgeKey, Holder, NodeId, ReflexId, Time, TypeId, Version};
use crate::state::{Cell, Edge, Node, State, same_transform};
use crate::value::Value;

/// One difference between two states.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum Change {
    /// An attribute went, alone or with its holder.
    AttributeRemoved { holder: Holder, attribute: AttributeId, old: Value },
    /// An edge went.
    EdgeRemoved { edge: EdgeKey },
    /// A child was taken off its parent.
    TransformRemoved { parent: NodeId, child: NodeId, old: Isometry3<f64> },
    /// A node went.
    NodeRemoved { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A node came.
    NodeAdded { node: NodeId, name: Arc<str>, node_type: TypeId },
    /// A child was hung below a parent.
    TransformAdded { parent: NodeId, child: NodeId, new: Isometry3<f64> },
    /// A child moved relative to its parent.
    TransformChanged { parent: NodeId, child: NodeId, old: Isometry3<f64>, new: Isometry3<f64> },
    /// An edge came.
    EdgeAdded { edge: EdgeKey },
    /// An attribute was given a value.
    AttributeAdded { holder: Holder, attribute: AttributeId, new: Value },
    /// An attribute was given another value.
    AttributeChanged { holder: Holder, attribute: AttributeId, old: Value, new: Value },
}

impl Change {
    /// Changes are listed by rank: what goes first, what it hung on after it; then what comes, after what it
    /// hangs on.
    fn rank(&self) -> u8 {
        match self {
            Self::AttributeRemoved { .. } => 0,
            Self::EdgeRemoved { .. } => 1,
            Self::TransformRemoved { .. } => 2,
            Self::NodeRemoved { .. } => 3,
            Self::NodeAdded { .. } => 4,
            Self::TransformAdded { .. } | Self::TransformChanged { .. } => 5,
            Self::EdgeAdded { .. } => 6,
            Self::AttributeAdded { .. } | Self::AttributeChanged { .. } => 7,
        }
    }
}

/// What one commit changed. Serialisable: the entry of a journal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Delta {
    /// The version that the commit made.
    pub version: Version,
    /// The time that the committer gave.
    pub time: Time,
    /// Who committed. Reflexes wrote as their owners.
    pub writer: AgentId,
    /// The differences, in an order in which they can be applied.
    pub changes: Vec<Change>,
    /// The reflexes that fired, in the order in which they did.
    pub reflexes: Vec<ReflexId>,
}

/// Compares what was touched with what was there, gives what stayed its old `since`, and lists the rest.
pub(crate) fn settle(before: &State, after: &mut State) -> Vec<Change> {
    let mut touched = std::mem::take(&mut after.scratch.touched);
    touched.sort_unstable();
    touched.dedup();
    let mut changes = Vec::new();
    for id in touched {
        let old = before.node(id);
        if old.is_some()
            && let Some(new) = after.node_quietly(id)
        {
            keep_since(old, new);
        }
        compare(after, id, old, &mut changes);
    }
    changes.sort_by_key(Change::rank);
    changes
}

/// Everything that is the same in both keeps the version in which it was written.
fn keep_since(old: Option<&Node>, new: &mut Node) {
    let Some(old) = old else { return };
    new.since = old.since;
    keep_cells(&old.attributes, &mut new.attributes);
    for edge in &mut new.outgoing {
        if let Some(was) = old.edge(edge.label, edge.to) {
            edge.since = was.since;
            keep_cells(&was.attributes, &mut edge.attributes);
        }
    }
    if let (Some(was), Some(joint)) = (&old.joint, &mut new.joint)
        && was.parent == joint.parent
        && same_transform(&was.transform, &joint.transform)
    {
        joint.since = was.since;
    }
}

fn keep_cells(old: &[Cell], new: &mut [Cell]) {
    for cell in new {
        if let Ok(at) = old.binary_search_by_key(&cell.attribute, |was| was.attribute)
            && old[at].value.same(&cell.value)
        {
            cell.since = old[at].since;
        }
    }
}

/// Lists the differences at one node.
fn compare(after: &State, id: NodeId, old: Option<&Node>, changes: &mut Vec<Change>) {
    let new = after.node(id);
    match (old, new) {
        (None, Some(node)) => {
            changes.push(Change::NodeAdded { node: id, name: node.name.clone(), node_type: node.node_type });
        }
        (Some(node), None) => {
            changes.push(Change::NodeRemoved {
                node: id,
                name: node.name.clone(),
                node_type: node.node_type,
            });
        }
        _ => {}
    }
    fn cells(node: Option<&Node>) -> &[Cell] {
        node.map_or(&[], |node| &node.attributes)
    }
    fn edges(node: Option<&Node>) -> &[Edge] {
        node.map_or(&[], |node| &node.outgoing)
    }
    compare_cells(after, Holder::Node(id), cells(old), cells(new), changes);

    for edge in edges(old) {
        let key = EdgeKey { from: id, label: edge.label, to: edge.to };
        let now = new.and_then(|node| node.edge(edge.label, edge.to));
        compare_cells(
            after,
            Holder::Edge(key),
            &edge.attributes,
            now.map_or(&[], |e| &e.attributes),
            changes,
        );
        if now.is_none() {
            changes.push(Change::EdgeRemoved { edge: key });
        }
    }
    for edge in edges(new) {
        if old.and_then(|node| node.edge(edge.label, edge.to)).is_none() {
            let key = EdgeKey { from: id, label: edge.label, to: edge.to };
            changes.push(Change::EdgeAdded { edge: key });
            compare_cells(after, Holder::Edge(key), &[], &edge.attributes, changes);
        }
    }
    compare_joints(id, old, new, changes);
}

fn compare_joints(child: NodeId, old: Option<&Node>, new: Option<&Node>, changes: &mut Vec<Change>) {
    let old = old.and_then(|node| node.joint.as_ref());
    let new = new.and_then(|node| node.joint.as_ref());
    match (old, new) {
        (Some(old), Some(new)) if old.parent == new.parent => {
            if !same_transform(&old.transform, &new.transform) {
                let (old, parent, new) = (old.transform, new.parent, new.transform);
                changes.push(Change::TransformChanged { parent, child, old, new });
            }
        }
        (old, new) => {
            if let Some(old) = old {
                let (parent, old) = (old.parent, old.transform);
                changes.push(Change::TransformRemoved { parent, child, old });
            }
            if let Some(new) = new {
                let (parent, new) = (new.parent, new.transform);
                changes.push(Change::TransformAdded { parent, child, new });
            }
        }
    }
}

fn compare_cells(after: &State, holder: Holder, old: &[Cell], new: &[Cell], changes: &mut Vec<Change>) {
    let find = |cells: &[Cell], attribute| {
        cells
            .binary_search_by_key(&attribute, |cell: &Cell| cell.attribute)
            .ok()
            .map(|at| cells[at].value.clone())
    };
    for cell in old {
        let (attribute, old) = (cell.attribute, cell.value.clone());
        match find(new, attribute) {
            None => changes.push(Change::AttributeRemoved { holder, attribute, old }),
            Some(new) if !new.same(&old) => {
                // The attribute went with the node that it named and came back with another value: said so,
                // because a change is applied after the nodes have gone.
                if old.as_node().is_some_and(|target| after.node(target).is_none()) {
                    changes.push(Change::AttributeRemoved { holder, attribute, old });
                    changes.push(Change::AttributeAdded { holder, attribute, new });
                } else {
                    changes.push(Change::AttributeChanged { holder, attribute, old, new });
                }
            }
            Some(_) => {}
        }
    }
    for cell in new {
        if find(old, cell.attribute).is_none() {
            let (attribute, new) = (cell.attribute, cell.value.clone());
            changes.push(Change::AttributeAdded { holder, attribute, new });
        }
    }
}

//! The difference between any two states of a graph.
//!
//! Idea: two snapshots share the blocks that were not written in between, so only blocks that differ are compared. The
//! result is the list of changes that a commit from the one state to the other would publish; a change that was
//! reverted in between is not in it. Invariant: applying it to the earlier state gives the later one, except for the
//! versions in which things were written. Cost: one comparison of references per page, and of what was written; states
//! that were read from files share nothing, so everything is compared.

use crate::block::{Joint, NODES, Node};
use crate::delta::{Change, replace_joint, replace_value};
use crate::id::{EdgeKey, Holder, NodeId};
use crate::snapshot::Snapshot;
use crate::state::State;

impl Snapshot {
    /// The changes that lead from this state to a later or earlier one of the same graph.
    pub fn diff(&self, other: &Snapshot) -> Vec<Change> {
        let (before, after) = (self.state(), other.state());
        let mut changes = Vec::new();
        for block in before.differing(after) {
            for id in (block * NODES..(block + 1) * NODES).map(NodeId::at) {
                nodes(before, after, id, &mut changes);
                joints(before.joint(id), after.joint(id), id, &mut changes);
            }
        }
        changes.sort_by_key(Change::order);
        changes
    }
}

fn nodes(before: &State, after: &State, id: NodeId, changes: &mut Vec<Change>) {
    let (old, new) = (before.node(id), after.node(id));
    // Ids are never used twice, so a node with the same id on both sides is the same node.
    match (old, new) {
        (Some(old), None) => {
            let (name, node_type) = (before.name(id), old.node_type());
            changes.push(Change::NodeRemoved { node: id, name, node_type });
        }
        (None, Some(new)) => {
            let (name, node_type) = (after.name(id), new.node_type());
            changes.push(Change::NodeAdded { node: id, name, node_type });
        }
        _ => {}
    }
    for holder in holders(id, old) {
        if let Holder::Edge(edge) = holder
            && after.edge(edge).is_none()
        {
            changes.push(Change::EdgeRemoved { edge });
        }
        for cell in cells(before, holder) {
            let attribute = cell.attribute;
            let old = cell.value.clone();
            match after.cell(holder, attribute) {
                None => changes.push(Change::AttributeRemoved { holder, attribute, old }),
                Some(new) if !new.value.same(&old) => {
                    replace_value(after, holder, attribute, (old, new.value.clone()), changes);
                }
                Some(_) => {}
            }
        }
    }
    for holder in holders(id, new) {
        if let Holder::Edge(edge) = holder
            && before.edge(edge).is_none()
        {
            changes.push(Change::EdgeAdded { edge });
        }
        for cell in cells(after, holder) {
            let attribute = cell.attribute;
            if before.cell(holder, attribute).is_none() {
                changes.push(Change::AttributeAdded { holder, attribute, new: cell.value.clone() });
            }
        }
    }
}

/// A node and its outgoing edges.
fn holders(id: NodeId, node: Option<Node<'_>>) -> impl Iterator<Item = Holder> {
    let edges = node.into_iter().flat_map(Node::outgoing);
    let edges = edges.map(move |edge| Holder::Edge(EdgeKey { from: id, label: edge.label, to: edge.to }));
    node.map(|_| Holder::Node(id)).into_iter().chain(edges)
}

fn cells(state: &State, holder: Holder) -> Vec<&crate::block::Cell> {
    match holder {
        Holder::Node(id) => state.node(id).map_or(Vec::new(), |node| node.cells().iter().collect()),
        Holder::Edge(EdgeKey { from, label, to }) => state
            .node(from)
            .map_or(Vec::new(), |node| node.edge_cells(label, to).iter().map(|edge| &edge.cell).collect()),
    }
}

fn joints(old: Option<&Joint>, new: Option<&Joint>, child: NodeId, changes: &mut Vec<Change>) {
    match (old, new) {
        (Some(old), Some(new)) if old.parent == new.parent => match (&old.track, &new.track) {
            (None, None) if old.pose.same(&new.pose) => return,
            (None, None) => {
                let (parent, old, new) = (new.parent, old.pose.clone(), new.pose.clone());
                changes.push(Change::TransformChanged { parent, child, old, new });
                return;
            }
            (Some(before), Some(after)) => {
                // One that was taken back while the buffer reached so far: only a new buffer can have done that.
                let lost = |time| time >= after.horizon() && after.sample(time).is_none();
                if !before.samples().any(|sample| lost(sample.time)) {
                    for sample in after.samples() {
                        let (parent, time, new) = (new.parent, sample.time, sample.pose.clone());
                        let old = before.sample(time).cloned();
                        if old.as_ref().is_none_or(|old| !old.same(&new)) {
                            changes.push(Change::TransformSampled { parent, child, time, old, new });
                        }
                    }
                    return;
                }
            }
            _ => {}
        },
        _ => {}
    }
    replace_joint(child, old, new, changes);
}

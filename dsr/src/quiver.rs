//! The two quivers as petgraph graphs, so that its algorithms and its DOT printer run on a snapshot.
//!
//! The graph itself is not kept in petgraph: a `StableDiGraph` is copied as a whole for every snapshot, and a
//! node's edges are a linked list to search. These views cost one pass, and are for looking, not for the hot path.

use nalgebra::Isometry3;
use petgraph::graphmap::DiGraphMap;
use petgraph::stable_graph::StableDiGraph;
use rustc_hash::FxHashMap;

use crate::id::{LabelId, NodeId};
use crate::snapshot::Snapshot;

impl Snapshot {
    /// The geometric quiver: nodes that take part in it, and the pose of each child in its parent.
    pub fn geometric_quiver(&self) -> DiGraphMap<NodeId, Isometry3<f64>> {
        let mut quiver = DiGraphMap::new();
        for node in self.nodes() {
            if let Some((parent, pose, _)) = node.parent() {
                quiver.add_edge(parent, node.id, *pose);
            }
        }
        quiver
    }

    /// The symbolic quiver: all nodes, and an edge per label. Nodes are added in the order of their ids.
    pub fn symbolic_quiver(&self) -> StableDiGraph<NodeId, LabelId> {
        let mut quiver = StableDiGraph::new();
        let index: FxHashMap<_, _> = self.nodes().map(|node| (node.id, quiver.add_node(node.id))).collect();
        for edge in self.edges() {
            if let (Some(&from), Some(&to)) = (index.get(&edge.key.from), index.get(&edge.key.to)) {
                quiver.add_edge(from, to, edge.key.label);
            }
        }
        quiver
    }
}

//! The two quivers as petgraph sees them, so that its algorithms and its DOT printer run on a snapshot.
//!
//! Nothing is copied: a [`Quiver`] is a reference to a snapshot that implements the traits of `petgraph::visit` for the
//! symbolic edges or for the rigid transforms. Node ids are positions that are never given out again, so a quiver's
//! `node_bound` counts removed nodes too. Cost: an allocation for each node whose neighbours are asked for; these views
//! are for looking, not for the hot path.

use std::collections::HashSet;
use std::fmt::Debug;
use std::marker::PhantomData;

use nalgebra::Isometry3;
use petgraph::visit::{
    Data, EdgeCount, EdgeRef, GraphBase, GraphProp, GraphRef, IntoEdgeReferences, IntoEdges,
    IntoEdgesDirected, IntoNeighbors, IntoNeighborsDirected, IntoNodeIdentifiers, IntoNodeReferences,
    NodeCount, NodeIndexable, NodeRef, Visitable,
};
use petgraph::{Directed, Direction};
use rustc_hash::FxBuildHasher;

use crate::id::{EdgeKey, LabelId, NodeId};
use crate::snapshot::{EdgeView, NodeView, Snapshot};

type Boxed<'s, T> = Box<dyn Iterator<Item = T> + 's>;

/// Which edges a quiver has: [`Symbolic`] or [`Geometric`].
pub trait Arrows: Copy {
    /// What identifies an edge.
    type Id: Copy + PartialEq + Debug;
    /// What an edge carries.
    type Weight;
    /// An edge of a snapshot.
    type Arrow<'s>: EdgeRef<NodeId = NodeId, EdgeId = Self::Id, Weight = Self::Weight> + 's;

    /// The edges that leave a node.
    fn leaving<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, Self::Arrow<'s>>;
    /// The edges that reach a node.
    fn reaching<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, Self::Arrow<'s>>;
    /// Whether a node takes part.
    fn has(node: &NodeView<'_>) -> bool;
}

/// All nodes, and an edge per label.
#[derive(Debug, Clone, Copy)]
pub struct Symbolic;

/// The nodes of the rooted tree, each parent with an edge to its child that carries the child's newest pose.
#[derive(Debug, Clone, Copy)]
pub struct Geometric;

/// An edge of the geometric quiver.
#[derive(Debug, Clone, Copy)]
pub struct TransformView<'s> {
    /// In whose frame the pose is.
    pub parent: NodeId,
    /// Whose pose it is.
    pub child: NodeId,
    /// The newest pose.
    pub pose: &'s Isometry3<f64>,
}

/// One quiver of a snapshot, for petgraph.
#[derive(Debug)]
pub struct Quiver<'s, A> {
    snapshot: &'s Snapshot,
    arrows: PhantomData<A>,
}

impl<A> Clone for Quiver<'_, A> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<A> Copy for Quiver<'_, A> {}

impl Snapshot {
    /// The symbolic quiver.
    ///
    /// ```
    /// use dsr::{AgentId, VocabularyBuilder, Graph, Nature, Time, TypeId};
    /// # fn main() -> Result<(), Box<dyn std::error::Error>> {
    /// let mut builder = VocabularyBuilder::new();
    /// let place = builder.node_type("place", None, Nature::Symbolic)?;
    /// let leads = builder.label("leads", place, place)?;
    /// let graph = Graph::new(builder.build());
    /// graph.edit(AgentId::DSR, Time(0), |tx| {
    ///     for name in ["hall", "ward", "store"] {
    ///         tx.add_node(name, place);
    ///     }
    ///     tx.add_edge("hall", leads, "ward").add_edge("ward", leads, "store");
    /// })?;
    /// let now = graph.snapshot();
    /// let (hall, store) = (now.node("hall").unwrap(), now.node("store").unwrap());
    /// let steps = petgraph::algo::dijkstra(now.symbolic_quiver(), hall, Some(store), |_| 1);
    /// assert_eq!(steps[&store], 2);
    /// # Ok(())
    /// # }
    /// ```
    pub fn symbolic_quiver(&self) -> Quiver<'_, Symbolic> {
        Quiver { snapshot: self, arrows: PhantomData }
    }

    /// The geometric quiver.
    pub fn geometric_quiver(&self) -> Quiver<'_, Geometric> {
        Quiver { snapshot: self, arrows: PhantomData }
    }
}

impl EdgeRef for EdgeView<'_> {
    type NodeId = NodeId;
    type EdgeId = EdgeKey;
    type Weight = LabelId;

    fn source(&self) -> NodeId {
        self.key.from
    }

    fn target(&self) -> NodeId {
        self.key.to
    }

    fn weight(&self) -> &LabelId {
        &self.key.label
    }

    fn id(&self) -> EdgeKey {
        self.key
    }
}

impl Arrows for Symbolic {
    type Id = EdgeKey;
    type Weight = LabelId;
    type Arrow<'s> = EdgeView<'s>;

    fn leaving<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, EdgeView<'s>> {
        Box::new(snapshot.get(node).into_iter().flat_map(|node| node.edges()))
    }

    fn reaching<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, EdgeView<'s>> {
        let keys = snapshot.get(node).into_iter().flat_map(|node| node.incoming());
        Box::new(keys.filter_map(|EdgeKey { from, label, to }| snapshot.edge(from, label, to)))
    }

    fn has(_: &NodeView<'_>) -> bool {
        true
    }
}

impl EdgeRef for TransformView<'_> {
    type NodeId = NodeId;
    /// The child: it has one parent.
    type EdgeId = NodeId;
    type Weight = Isometry3<f64>;

    fn source(&self) -> NodeId {
        self.parent
    }

    fn target(&self) -> NodeId {
        self.child
    }

    fn weight(&self) -> &Isometry3<f64> {
        self.pose
    }

    fn id(&self) -> NodeId {
        self.child
    }
}

impl Geometric {
    fn above(snapshot: &Snapshot, child: NodeId) -> Option<TransformView<'_>> {
        let (parent, pose, _) = snapshot.get(child)?.parent()?;
        Some(TransformView { parent, child, pose: &pose.transform })
    }
}

impl Arrows for Geometric {
    type Id = NodeId;
    type Weight = Isometry3<f64>;
    type Arrow<'s> = TransformView<'s>;

    fn leaving<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, TransformView<'s>> {
        let children = snapshot.get(node).map_or(&[][..], |node| node.children());
        Box::new(children.iter().filter_map(|&child| Self::above(snapshot, child)))
    }

    fn reaching<'s>(snapshot: &'s Snapshot, node: NodeId) -> Boxed<'s, TransformView<'s>> {
        Box::new(Self::above(snapshot, node).into_iter())
    }

    fn has(node: &NodeView<'_>) -> bool {
        node.parent().is_some() || !node.children().is_empty()
    }
}

impl<A: Arrows> GraphBase for Quiver<'_, A> {
    type NodeId = NodeId;
    type EdgeId = A::Id;
}

impl<A: Arrows> GraphRef for Quiver<'_, A> {}

impl<A: Arrows> GraphProp for Quiver<'_, A> {
    type EdgeType = Directed;
}

impl<'s, A: Arrows> Data for Quiver<'s, A> {
    type NodeWeight = NodeView<'s>;
    type EdgeWeight = A::Weight;
}

impl<'s> NodeRef for NodeView<'s> {
    type NodeId = NodeId;
    type Weight = NodeView<'s>;

    fn id(&self) -> NodeId {
        self.id
    }

    fn weight(&self) -> &Self {
        self
    }
}

impl<'s, A: Arrows + 's> IntoNodeReferences for Quiver<'s, A> {
    type NodeRef = NodeView<'s>;
    type NodeReferences = Boxed<'s, NodeView<'s>>;

    fn node_references(self) -> Self::NodeReferences {
        Box::new(self.snapshot.nodes().filter(A::has))
    }
}

impl<'s, A: Arrows + 's> IntoNodeIdentifiers for Quiver<'s, A> {
    type NodeIdentifiers = Boxed<'s, NodeId>;

    fn node_identifiers(self) -> Self::NodeIdentifiers {
        Box::new(self.node_references().map(|node| node.id))
    }
}

impl<'s, A: Arrows + 's> IntoEdgeReferences for Quiver<'s, A> {
    type EdgeRef = A::Arrow<'s>;
    type EdgeReferences = Boxed<'s, A::Arrow<'s>>;

    fn edge_references(self) -> Self::EdgeReferences {
        Box::new(self.node_identifiers().flat_map(move |node| A::leaving(self.snapshot, node)))
    }
}

impl<'s, A: Arrows + 's> IntoEdges for Quiver<'s, A> {
    type Edges = Boxed<'s, A::Arrow<'s>>;

    fn edges(self, node: NodeId) -> Self::Edges {
        A::leaving(self.snapshot, node)
    }
}

impl<'s, A: Arrows + 's> IntoEdgesDirected for Quiver<'s, A> {
    type EdgesDirected = Boxed<'s, A::Arrow<'s>>;

    fn edges_directed(self, node: NodeId, direction: Direction) -> Self::EdgesDirected {
        match direction {
            Direction::Outgoing => A::leaving(self.snapshot, node),
            Direction::Incoming => A::reaching(self.snapshot, node),
        }
    }
}

impl<'s, A: Arrows + 's> IntoNeighbors for Quiver<'s, A> {
    type Neighbors = Boxed<'s, NodeId>;

    fn neighbors(self, node: NodeId) -> Self::Neighbors {
        Box::new(A::leaving(self.snapshot, node).map(|arrow| arrow.target()))
    }
}

impl<'s, A: Arrows + 's> IntoNeighborsDirected for Quiver<'s, A> {
    type NeighborsDirected = Boxed<'s, NodeId>;

    fn neighbors_directed(self, node: NodeId, direction: Direction) -> Self::NeighborsDirected {
        match direction {
            Direction::Outgoing => self.neighbors(node),
            Direction::Incoming => Box::new(A::reaching(self.snapshot, node).map(|arrow| arrow.source())),
        }
    }
}

impl<A: Arrows> NodeCount for Quiver<'_, A> {
    fn node_count(&self) -> usize {
        self.snapshot.nodes().filter(A::has).count()
    }
}

impl<A: Arrows> EdgeCount for Quiver<'_, A> {
    fn edge_count(&self) -> usize {
        self.edge_references().count()
    }
}

impl<A: Arrows> NodeIndexable for Quiver<'_, A> {
    fn node_bound(&self) -> usize {
        self.snapshot.state().next.index()
    }

    fn to_index(&self, node: NodeId) -> usize {
        node.index()
    }

    fn from_index(&self, index: usize) -> NodeId {
        NodeId::at(index)
    }
}

impl<A: Arrows> Visitable for Quiver<'_, A> {
    type Map = HashSet<NodeId, FxBuildHasher>;

    fn visit_map(&self) -> Self::Map {
        HashSet::default()
    }

    fn reset_map(&self, map: &mut Self::Map) {
        map.clear();
    }
}

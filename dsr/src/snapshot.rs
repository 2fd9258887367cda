//! Snapshots: one immutable state of the graph.
//!
//! Taking a snapshot costs a reference count, and reading one takes no lock. Holding one keeps in memory what later
//! commits overwrite.

use std::sync::Arc;

use nalgebra::Isometry3;

use crate::block::{Cell, EdgeCell, Node};
use crate::chain::{self, ChainError};
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, ResourceId, Time, TypeId, Version};
use crate::lease::{self, Lease, Waiting};
use crate::pose::Pose;
use crate::state::State;
use crate::value::Value;
use crate::vocabulary::Vocabulary;

/// An immutable state of the graph.
#[derive(Debug, Clone)]
pub struct Snapshot {
    state: Arc<State>,
}

/// An attribute as a snapshot shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AttributeView<'a> {
    /// Which attribute.
    pub attribute: AttributeId,
    /// Its value.
    pub value: &'a Value,
    /// The version that wrote it.
    pub since: Version,
}

/// An edge as a snapshot shows it.
#[derive(Debug, Clone, Copy)]
pub struct EdgeView<'a> {
    /// Which edge.
    pub key: EdgeKey,
    since: Version,
    cells: &'a [EdgeCell],
}

impl<'a> EdgeView<'a> {
    /// The version that added it.
    pub fn since(&self) -> Version {
        self.since
    }

    /// Its attributes, by id.
    pub fn attributes(&self) -> impl Iterator<Item = AttributeView<'a>> + use<'a> {
        self.cells.iter().map(|edge| edge.cell.view())
    }
}

/// A node as a snapshot shows it.
#[derive(Debug, Clone, Copy)]
pub struct NodeView<'a> {
    /// Which node.
    pub id: NodeId,
    node: Node<'a>,
    state: &'a State,
}

impl<'a> NodeView<'a> {
    /// Its name.
    pub fn name(&self) -> &'a str {
        self.state.names.of(self.id).map_or("", |name| name)
    }

    /// Its type.
    pub fn node_type(&self) -> TypeId {
        self.node.node_type()
    }

    /// The version that added it.
    pub fn since(&self) -> Version {
        self.node.since()
    }

    /// Its attributes, by id.
    pub fn attributes(&self) -> impl Iterator<Item = AttributeView<'a>> + use<'a> {
        self.node.cells().iter().map(Cell::view)
    }

    /// Its outgoing edges, by label and end.
    pub fn edges(&self) -> impl Iterator<Item = EdgeView<'a>> + use<'a> {
        let (from, node) = (self.id, self.node);
        node.outgoing().iter().map(move |edge| EdgeView {
            key: EdgeKey { from, label: edge.label, to: edge.to },
            since: edge.since,
            cells: node.edge_cells(edge.label, edge.to),
        })
    }

    /// Its incoming edges, by label and start.
    pub fn incoming(&self) -> impl Iterator<Item = EdgeKey> + use<'a> {
        let to = self.id;
        self.node.incoming().iter().map(move |&(label, from)| EdgeKey { from, label, to })
    }

    /// Its parent in the geometric quiver, its newest pose there, and the version that wrote it.
    pub fn parent(&self) -> Option<(NodeId, &'a Pose, Version)> {
        self.state.joint(self.id).map(|joint| (joint.parent, &joint.pose, joint.since))
    }

    /// The stamped poses of a moving node in its parent, in order of time; empty for a static one.
    pub fn poses(&self) -> impl Iterator<Item = (Time, &'a Pose)> + use<'a> {
        let track = self.state.joint(self.id).and_then(|joint| joint.track.as_ref());
        track.into_iter().flat_map(|track| track.samples()).map(|sample| (sample.time, &sample.pose))
    }

    /// Its children in the geometric quiver, by id.
    pub fn children(&self) -> &'a [NodeId] {
        self.state.children(self.id)
    }
}

impl Cell {
    fn view(&self) -> AttributeView<'_> {
        AttributeView { attribute: self.attribute, value: &self.value, since: self.since }
    }
}

impl Snapshot {
    pub(crate) fn new(state: Arc<State>) -> Self {
        Self { state }
    }

    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// The version.
    pub fn version(&self) -> Version {
        self.state.version
    }

    /// The time of the commit that made it.
    pub fn time(&self) -> Time {
        self.state.time
    }

    /// The vocabulary of the graph.
    pub fn vocabulary(&self) -> &Arc<Vocabulary> {
        &self.state.vocabulary
    }

    /// The node of that name.
    pub fn node(&self, name: &str) -> Option<NodeId> {
        self.state.names.get(name)
    }

    /// A node.
    pub fn get(&self, id: NodeId) -> Option<NodeView<'_>> {
        self.state.node(id).map(|node| NodeView { id, node, state: &self.state })
    }

    /// The name of a node.
    pub fn name(&self, id: NodeId) -> Option<&str> {
        self.state.names.of(id).map(|name| &**name)
    }

    /// All nodes, by id.
    pub fn nodes(&self) -> impl Iterator<Item = NodeView<'_>> {
        self.state.nodes().map(|(id, node)| NodeView { id, node, state: &self.state })
    }

    /// The nodes of a type and its subtypes, by type and id.
    pub fn nodes_of(&self, node_type: TypeId) -> impl Iterator<Item = NodeId> + '_ {
        let vocabulary = &self.state.vocabulary;
        let subtypes = vocabulary.types().filter(move |&sub| vocabulary.is_a(sub, node_type));
        subtypes.flat_map(|sub| self.state.nodes_exactly(sub))
    }

    /// All symbolic edges, by start, label and end.
    pub fn edges(&self) -> impl Iterator<Item = EdgeView<'_>> {
        self.nodes().flat_map(|node| node.edges())
    }

    /// An edge.
    pub fn edge(&self, from: NodeId, label: LabelId, to: NodeId) -> Option<EdgeView<'_>> {
        let key = EdgeKey { from, label, to };
        let node = self.state.node(from)?;
        node.edge(label, to).map(|edge| EdgeView {
            key,
            since: edge.since,
            cells: node.edge_cells(label, to),
        })
    }

    /// Whether the edge exists.
    pub fn has_edge(&self, from: NodeId, label: LabelId, to: NodeId) -> bool {
        self.edge(from, label, to).is_some()
    }

    /// The value of an attribute.
    pub fn attribute(&self, holder: impl Into<Holder>, attribute: AttributeId) -> Option<&Value> {
        self.state.cell(holder.into(), attribute).map(|cell| &cell.value)
    }

    /// The pose of frame `to` in frame `from`, by the newest pose of each edge between them. It maps coordinates of
    /// `to` into `from`; see the README.
    pub fn transform(&self, from: NodeId, to: NodeId) -> Result<Isometry3<f64>, ChainError> {
        chain::transform(&self.state, from, to)
    }

    /// The pose of frame `to` in frame `from` at a time. The poses of moving frames are interpolated. A time for which
    /// an edge has no pose is an error with the names of that edge.
    pub fn transform_at(&self, from: NodeId, to: NodeId, time: Time) -> Result<Isometry3<f64>, ChainError> {
        chain::transform_at(&self.state, from, to, time)
    }

    /// The newest time for which every edge between the two frames has a pose; `None` if all are static.
    pub fn common_time(&self, from: NodeId, to: NodeId) -> Result<Option<Time>, ChainError> {
        chain::common_time(&self.state, from, to)
    }

    /// The pose of frame `to` in frame `from` at their newest common time.
    pub fn transform_together(&self, from: NodeId, to: NodeId) -> Result<Isometry3<f64>, ChainError> {
        chain::transform_together(&self.state, from, to)
    }

    /// The newest pose of frame `to` in frame `from` with its covariance, to first order. There is no covariance if no
    /// edge between them has one, or if a moving edge has none. See [`Covariance`](crate::Covariance).
    pub fn pose(&self, from: NodeId, to: NodeId) -> Result<Pose, ChainError> {
        chain::pose(&self.state, from, to)
    }

    /// Like [`Snapshot::pose`], at a time.
    pub fn pose_at(&self, from: NodeId, to: NodeId, time: Time) -> Result<Pose, ChainError> {
        chain::pose_at(&self.state, from, to, time)
    }

    /// The distance between the origins of two frames.
    pub fn distance(&self, from: NodeId, to: NodeId) -> Result<f64, ChainError> {
        chain::distance(&self.state, from, to)
    }

    /// The direction of the origin of frame `to` in the plane of frame `from`: radians from its x axis, positive
    /// towards y, in (-π, π].
    pub fn bearing(&self, from: NodeId, to: NodeId) -> Result<f64, ChainError> {
        chain::bearing(&self.state, from, to)
    }

    /// Whether the distance from frame `from` to frame `to` is at most the attribute `reach` of `from`, in metres;
    /// false if the attribute has no value.
    pub fn reachable(&self, from: NodeId, to: NodeId, reach: AttributeId) -> Result<bool, ChainError> {
        let reach = self.attribute(from, reach).and_then(Value::as_number);
        Ok(Some(self.distance(from, to)?) <= reach)
    }

    /// The root of the geometric quiver, if it has any transform.
    pub fn root(&self) -> Option<NodeId> {
        self.state.root
    }

    /// The lease of a resource, if an agent holds it.
    pub fn lease(&self, resource: ResourceId) -> Option<Lease> {
        lease::lease(&self.state, resource)
    }

    /// The agents that wait for a resource, the next holder first.
    pub fn waiting(&self, resource: ResourceId) -> Vec<Waiting> {
        lease::waiting(&self.state, resource)
    }

    /// The resource for which an agent waits.
    pub fn awaited(&self, agent: AgentId) -> Option<ResourceId> {
        lease::awaited(&self.state, agent)
    }
}

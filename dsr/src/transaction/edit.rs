//! Edits: the elements of a transaction.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AgentId, AttributeId, Holder, LabelId, ResourceId, Time, TypeId};
use crate::lease::{Preemption, Priority};
use crate::pose::Pose;
use crate::value::{NewValue, NodeRef};

/// The holder of an attribute in an edit.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum HolderRef {
    /// A node.
    Node(NodeRef),
    /// An edge, which must exist when its attribute is set.
    Edge { from: NodeRef, label: LabelId, to: NodeRef },
}

impl HolderRef {
    /// A node.
    pub fn node(node: impl Into<NodeRef>) -> Self {
        Self::Node(node.into())
    }

    /// An edge.
    pub fn edge(from: impl Into<NodeRef>, label: LabelId, to: impl Into<NodeRef>) -> Self {
        Self::Edge { from: from.into(), label, to: to.into() }
    }
}

impl<N: Into<NodeRef>> From<N> for HolderRef {
    fn from(node: N) -> Self {
        Self::Node(node.into())
    }
}

impl From<Holder> for HolderRef {
    fn from(holder: Holder) -> Self {
        match holder {
            Holder::Node(node) => Self::node(node),
            Holder::Edge(key) => Self::edge(key.from, key.label, key.to),
        }
    }
}

/// One edit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the fields are the terms of the variant")]
pub enum Edit {
    /// Adds a node; names are unique.
    AddNode { name: Arc<str>, node_type: TypeId },
    /// Removes a node with its edges, attributes, transforms and the attributes that refer to it.
    RemoveNode { node: NodeRef },
    /// Adds an edge; no change if it exists.
    AddEdge { from: NodeRef, label: LabelId, to: NodeRef },
    /// Removes an edge with its attributes; no change if it does not exist.
    RemoveEdge { from: NodeRef, label: LabelId, to: NodeRef },
    /// Sets an attribute; no change if it already has this value.
    SetAttribute { holder: HolderRef, attribute: AttributeId, value: NewValue },
    /// Removes an attribute; no change if the attribute or its edge does not exist.
    ClearAttribute { holder: HolderRef, attribute: AttributeId },
    /// Sets the static pose of `child` in the frame of `parent`. It holds at all times until it is changed.
    SetTransform { parent: NodeRef, child: NodeRef, pose: Pose },
    /// Adds the pose of a moving `child` in the frame of `parent` at a time. The transform keeps the poses of the ten
    /// seconds before its newest. No change if the time is older than that.
    SampleTransform { parent: NodeRef, child: NodeRef, time: Time, pose: Pose },
    /// Removes the transform between `parent` and `child`; no change if there is none.
    RemoveTransform { parent: NodeRef, child: NodeRef },
    /// Takes a lease for the writer, also from a holder of lower priority whose lease yields.
    Claim { resource: ResourceId, priority: Priority, preemption: Preemption },
    /// Claims a lease, or makes the writer wait for its turn: it then gets the lease in the commit that frees the
    /// resource. Rejected if the holder waits for the writer, directly or through others. An agent waits for at most
    /// one lease.
    Await { resource: ResourceId, priority: Priority, preemption: Preemption },
    /// Releases the writer's lease, or ends its wait; no change if it has neither.
    Release { resource: ResourceId },
    /// Releases all leases of an agent, ends its wait and breaks all its reflexes. Only the agent itself and
    /// [`AgentId::DSR`] may write it.
    Expire { agent: AgentId },
}

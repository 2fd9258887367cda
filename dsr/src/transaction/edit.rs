//! Edits: what a transaction is a list of.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AgentId, AttributeId, Holder, LabelId, ResourceId, Time, TypeId};
use crate::lease::{Preemption, Priority};
use crate::pose::Pose;
use crate::value::{NewValue, NodeRef};

/// Names the holder of an attribute in an edit.
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
    /// Adds an edge; no change if it is there.
    AddEdge { from: NodeRef, label: LabelId, to: NodeRef },
    /// Removes an edge with its attributes; no change if it is not there.
    RemoveEdge { from: NodeRef, label: LabelId, to: NodeRef },
    /// Gives an attribute a value; no change if it has it.
    SetAttribute { holder: HolderRef, attribute: AttributeId, value: NewValue },
    /// Takes an attribute away; no change if it, or the edge that would hold it, is not there.
    ClearAttribute { holder: HolderRef, attribute: AttributeId },
    /// Gives the pose of `child` in the frame of `parent`, which holds at all times until it is changed.
    SetTransform { parent: NodeRef, child: NodeRef, pose: Pose },
    /// Says where `child` was in the frame of `parent` at a time, and that it moves: the edge keeps the poses of the
    /// last ten seconds before its newest. No change if the time lies further back.
    SampleTransform { parent: NodeRef, child: NodeRef, time: Time, pose: Pose },
    /// Takes `child` off `parent`; no change if it does not hang there.
    RemoveTransform { parent: NodeRef, child: NodeRef },
    /// Takes a lease for the writer, from a holder of lower priority if that one yields.
    Claim { resource: ResourceId, priority: Priority, preemption: Preemption },
    /// Takes a lease for the writer as a claim does, or has the writer wait until it is its turn: the lease comes with
    /// the commit that frees the resource. Refused where the holder waits for the writer. An agent waits for one at most.
    Await { resource: ResourceId, priority: Priority, preemption: Preemption },
    /// Gives the writer's lease back, or its place among those who wait; no change if it has neither.
    Release { resource: ResourceId },
    /// Drops all leases and waits of an agent and breaks all its reflexes. For the agent itself and for [`AgentId::DSR`].
    Expire { agent: AgentId },
}

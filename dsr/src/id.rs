//! Identifiers: small copyable names for what the vocabulary declares and the graph holds.
//!
//! Problem: people read and write strings, but comparing strings on every edit is slow, and a bare integer can be
//! passed in the wrong place. Idea: one newtype over `u32` for each kind of thing. Invariant: an id is valid only with
//! the vocabulary or graph that issued it. A foreign id gives an error, never a panic.

use serde::{Deserialize, Serialize};

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident)*) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub(crate) u32);

        impl $name {
            /// The position of this id in its table.
            pub const fn index(self) -> usize {
                self.0 as usize
            }

            #[allow(dead_code)]
            pub(crate) fn at(index: usize) -> Self {
                Self(u32::try_from(index).expect("a table of 2^32 names does not fit in memory"))
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, "#{}", self.0)
            }
        }
    )*};
}

ids! {
    /// A type of nodes.
    TypeId
    /// A label of symbolic edges.
    LabelId
    /// An attribute of nodes or of edges.
    AttributeId
    /// An agent: a writer of the graph.
    AgentId
    /// An exclusive resource.
    ResourceId
    /// A node of the graph. Ids of removed nodes are never used again.
    NodeId
}

impl TypeId {
    /// `object`, the root of the hierarchy of types.
    pub const OBJECT: Self = Self(0);
    /// `agent`, the type of the nodes that stand for writers.
    pub const AGENT: Self = Self(1);
    /// `resource`, the type of the nodes that stand for exclusive resources.
    pub const RESOURCE: Self = Self(2);
}

impl LabelId {
    /// `holds`: an agent holds a resource. Only claims and releases write it.
    pub const HOLDS: Self = Self(0);
    /// `awaits`: an agent waits for a resource. Only the graph writes it.
    pub const AWAITS: Self = Self(1);
}

impl AttributeId {
    /// `priority` of a lease, on the edge `holds`.
    pub const PRIORITY: Self = Self(0);
    /// `yields`: whether a claim of higher priority may take the lease at once, on the edge `holds`.
    pub const YIELDS: Self = Self(1);
    /// `claim`: the version in which the lease was granted, on the edge `holds`.
    pub const CLAIM: Self = Self(2);
    /// `awaits_priority` of a wait, on the edge `awaits`.
    pub const AWAITS_PRIORITY: Self = Self(3);
    /// `awaits_yields`: whether the lease will yield, on the edge `awaits`.
    pub const AWAITS_YIELDS: Self = Self(4);
    /// `asked`: the version in which the agent asked for the lease, on the edge `awaits`.
    pub const ASKED: Self = Self(5);
}

impl AgentId {
    /// `dsr`, the graph itself: sets up the world, expires dead agents, may write every token.
    pub const DSR: Self = Self(0);
}

impl NodeId {
    /// Stands for a node that does not exist; no node has this id.
    pub(crate) const NOWHERE: Self = Self(u32::MAX);
}

/// The number of a state of the graph; each commit that changes something adds one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Version(pub u64);

/// Nanoseconds on the clock of the committer. The graph orders by version and never reads a clock.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Time(pub u64);

/// One life of an agent: from [`Graph::attend`](crate::Graph::attend) until the agent expires or is attended again.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Epoch(pub u64);

/// A registered reflex. Ids are never used twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(transparent)]
pub struct ReflexId(pub u64);

/// Identifies a symbolic edge: there is at most one per label and ordered pair of nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct EdgeKey {
    /// Where it starts.
    pub from: NodeId,
    /// Its label.
    pub label: LabelId,
    /// Where it ends.
    pub to: NodeId,
}

/// What carries an attribute.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Holder {
    /// A node.
    Node(NodeId),
    /// A symbolic edge.
    Edge(EdgeKey),
}

impl From<NodeId> for Holder {
    fn from(node: NodeId) -> Self {
        Self::Node(node)
    }
}

impl From<EdgeKey> for Holder {
    fn from(edge: EdgeKey) -> Self {
        Self::Edge(edge)
    }
}

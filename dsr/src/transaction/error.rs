//! Why a transaction is rejected. Every variant carries the names that it is about. The graph has not changed.

use std::sync::Arc;

use crate::id::{AgentId, AttributeId, LabelId, ReflexId, ResourceId, TypeId, Version};
use crate::lease::{Preemption, Priority};
use crate::unit::Unit;
use crate::value::{Kind, NodeRef};

type Name = Arc<str>;

/// Why a transaction is rejected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum TransactionError {
    /// The vocabulary has no such agent.
    #[error("no agent {id}")]
    UnknownAgent { id: AgentId },
    /// No such node.
    #[error("no node '{node}'")]
    UnknownNode { node: NodeRef },
    /// The vocabulary has no such type.
    #[error("no type {id}")]
    UnknownType { id: TypeId },
    /// The vocabulary has no such label.
    #[error("no label {id}")]
    UnknownLabel { id: LabelId },
    /// The vocabulary has no such attribute.
    #[error("no attribute {id}")]
    UnknownAttribute { id: AttributeId },
    /// The vocabulary has no such resource.
    #[error("no resource {id}")]
    UnknownResource { id: ResourceId },
    /// A node without a name.
    #[error("a node needs a name")]
    EmptyName,
    /// A node has that name.
    #[error("there is a node '{name}' already")]
    DuplicateNode { name: Name },
    /// All node ids have been used.
    #[error("no node id is left")]
    Full,
    /// A token that only the graph itself writes: the nodes of agents and resources, leases.
    #[error("'{name}' is written by the graph itself")]
    Reserved { name: Name },
    /// A symbolic edge from a node to itself (symbolic quiver, property 2).
    #[error("'{label}' from '{node}' to itself")]
    Loop { node: Name, label: Name },
    /// The label does not connect nodes of these types.
    #[error("'{label}' does not go from '{from}' ({from_type}) to '{to}' ({to_type})")]
    WrongSignature { label: Name, from: Name, from_type: Name, to: Name, to_type: Name },
    /// An attribute of an edge that does not exist.
    #[error("no edge '{from}' {label} '{to}'")]
    MissingEdge { from: Name, label: Name, to: Name },
    /// The attribute is declared for other holders.
    #[error("attribute '{attribute}' does not belong on {holder}")]
    WrongHolder { attribute: Name, holder: Name },
    /// The value has another kind than the attribute.
    #[error("attribute '{attribute}' is a {expected}, not a {found}")]
    WrongKind { attribute: Name, expected: Kind, found: &'static str },
    /// The quantity has another dimension than the attribute, or the attribute has no unit.
    #[error("attribute '{attribute}' is measured in {}, not in {found}", expected.map_or_else(|| "no unit".to_owned(), |unit| unit.to_string()))]
    WrongUnit { attribute: Name, expected: Option<Unit>, found: Unit },
    /// The value names a node of the wrong type.
    #[error("attribute '{attribute}' refers to a '{expected}', and '{node}' is a '{node_type}'")]
    WrongTarget { attribute: Name, expected: Name, node: Name, node_type: Name },
    /// A number or a transform that is infinite or not a number.
    #[error("{token} is not finite")]
    NotFinite { token: Name },
    /// A rotation that is not a unit quaternion.
    #[error("the pose of '{child}' in '{parent}' has a rotation that is no unit quaternion")]
    NotRigid { parent: Name, child: Name },
    /// More edges of a label would leave a node than the vocabulary allows.
    #[error("at most {most} '{label}' may leave '{node}'")]
    TooManyLeave { node: Name, label: Name, most: u32 },
    /// More edges of a label would reach a node than the vocabulary allows.
    #[error("at most {most} '{label}' may reach '{node}'")]
    TooManyReach { node: Name, label: Name, most: u32 },
    /// The writer has no permission for the token there.
    #[error("'{writer}' may not write {token} at '{from}'{}", to.as_ref().map(|to| format!(", '{to}'")).unwrap_or_default())]
    Forbidden { writer: Name, token: Name, from: Name, to: Option<Name> },
    /// A transform at a node whose type is not geometric.
    #[error("'{node}' ({node_type}) is not geometric")]
    NotGeometric { node: Name, node_type: Name },
    /// A second parent (geometric quiver, properties 2 and 3).
    #[error("'{child}' hangs below '{parent}', it cannot hang below '{refused}' too")]
    SecondParent { child: Name, parent: Name, refused: Name },
    /// A cycle of transforms (geometric quiver, property 1).
    #[error("'{child}' below '{parent}' closes a cycle")]
    Cycle { parent: Name, child: Name },
    /// Two trees of transforms (geometric quiver, property 3).
    #[error("two roots: '{root}' and '{other}'")]
    SecondRoot { root: Name, other: Name },
    /// A subtree would lose its path to the root (geometric quiver, property 3).
    #[error("taking '{child}' off '{parent}' cuts off what hangs below '{child}'")]
    Disconnected { parent: Name, child: Name },
    /// Another agent holds the resource: with a priority that is not lower, or with a lease that does not yield.
    #[error("'{holder}' holds '{resource}' with priority {}", priority.0)]
    ResourceHeld { resource: Name, holder: Name, priority: Priority, preemption: Preemption },
    /// The writer already waits for a resource; an agent waits for at most one.
    #[error("'{writer}' waits for '{resource}' already")]
    WaitsAlready { writer: Name, resource: Name },
    /// The writer would wait for an agent that waits for the writer. The cycle: each resource with its holder.
    #[error("'{writer}' would wait for itself: {}", named(circle))]
    Deadlock { writer: Name, circle: Vec<(Name, Name)> },
    /// The graph is at another version than the expected one.
    #[error("expected version {}, the graph is at {}", expected.0, current.0)]
    Stale { expected: Version, current: Version },
    /// The life of the agent for which this was written is over: the agent has expired, or was attended again.
    #[error("this life of '{agent}' is over")]
    Fenced { agent: Name },
    /// The reflex to be dismissed has fired or was dismissed before.
    #[error("reflex {} is gone", reflex.0)]
    ReflexGone { reflex: ReflexId },
    /// The reflex or the expiry concerns another agent.
    #[error("'{writer}' cannot act for '{owner}'")]
    NotOwner { writer: Name, owner: Name },
    /// A condition of a new reflex does not hold.
    #[error("condition {keep} of a new reflex of '{owner}' does not hold")]
    KeepBroken { owner: Name, keep: usize },
    /// A new reflex names a lease that its owner does not hold.
    #[error("'{owner}' does not hold '{resource}'")]
    NotHeld { owner: Name, resource: Name },
    /// A new reflex would claim or await a lease. It may fire because its owner has expired, and an expired agent holds
    /// none.
    #[error("a reflex of '{owner}' would take '{resource}'")]
    ReflexClaims { owner: Name, resource: Name },
    /// The edits of a new reflex would be rejected.
    #[error("a reflex of '{owner}' could not fire: {error}")]
    ReflexRefused { owner: Name, error: Box<TransactionError> },
}

fn named(circle: &[(Name, Name)]) -> String {
    let step = |(resource, holder): &(Name, Name)| format!("'{resource}' is held by '{holder}'");
    circle.iter().map(step).collect::<Vec<_>>().join(", who waits: ")
}

//! Why a transaction is refused. Every variant carries the names it is about; the graph is untouched.

use std::sync::Arc;

use crate::id::{AgentId, AttributeId, LabelId, ReflexId, ResourceId, TypeId, Version};
use crate::lease::{Preemption, Priority};
use crate::unit::Unit;
use crate::value::{Kind, NodeRef};

type Name = Arc<str>;

/// Why a transaction is refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum TransactionError {
    /// The writer is of another vocabulary.
    #[error("no agent {id}")]
    UnknownAgent { id: AgentId },
    /// No such node.
    #[error("no node '{node}'")]
    UnknownNode { node: NodeRef },
    /// The type is of another vocabulary.
    #[error("no type {id}")]
    UnknownType { id: TypeId },
    /// The label is of another vocabulary.
    #[error("no label {id}")]
    UnknownLabel { id: LabelId },
    /// The attribute is of another vocabulary.
    #[error("no attribute {id}")]
    UnknownAttribute { id: AttributeId },
    /// The resource is of another vocabulary.
    #[error("no resource {id}")]
    UnknownResource { id: ResourceId },
    /// A node without a name.
    #[error("a node needs a name")]
    EmptyName,
    /// A node has that name.
    #[error("there is a node '{name}' already")]
    DuplicateNode { name: Name },
    /// All ids have been given out.
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
    /// An attribute of an edge that is not there.
    #[error("no edge '{from}' {label} '{to}'")]
    MissingEdge { from: Name, label: Name, to: Name },
    /// The attribute does not belong on that holder.
    #[error("attribute '{attribute}' does not belong on {holder}")]
    WrongHolder { attribute: Name, holder: Name },
    /// The value is not of the declared kind.
    #[error("attribute '{attribute}' is a {expected}, not a {found}")]
    WrongKind { attribute: Name, expected: Kind, found: &'static str },
    /// A quantity of an attribute that is measured in something else, or in nothing.
    #[error("attribute '{attribute}' is measured in {}, not in {found}", expected.map_or_else(|| "no unit".to_owned(), |unit| unit.to_string()))]
    WrongUnit { attribute: Name, expected: Option<Unit>, found: Unit },
    /// The value names a node of the wrong type.
    #[error("attribute '{attribute}' refers to a '{expected}', and '{node}' is a '{node_type}'")]
    WrongTarget { attribute: Name, expected: Name, node: Name, node_type: Name },
    /// A number or a transform that is infinite or not a number.
    #[error("{token} is not finite")]
    NotFinite { token: Name },
    /// A rotation that is no unit quaternion.
    #[error("the pose of '{child}' in '{parent}' has a rotation that is no unit quaternion")]
    NotRigid { parent: Name, child: Name },
    /// More edges of a label would leave a node than the vocabulary allows.
    #[error("at most {most} '{label}' may leave '{node}'")]
    TooManyLeave { node: Name, label: Name, most: u32 },
    /// More edges of a label would reach a node than the vocabulary allows.
    #[error("at most {most} '{label}' may reach '{node}'")]
    TooManyReach { node: Name, label: Name, most: u32 },
    /// The writer does not own the token there.
    #[error("'{writer}' may not write {token} at '{from}'{}", to.as_ref().map(|to| format!(", '{to}'")).unwrap_or_default())]
    Forbidden { writer: Name, token: Name, from: Name, to: Option<Name> },
    /// A transform at a node that has no place in the geometric quiver.
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
    /// A subtree lost its way to the root (geometric quiver, property 3).
    #[error("taking '{child}' off '{parent}' cuts off what hangs below '{child}'")]
    Disconnected { parent: Name, child: Name },
    /// The resource is held, by a priority that is not lower or by a holder that finishes first.
    #[error("'{holder}' holds '{resource}' with priority {}", priority.0)]
    ResourceHeld { resource: Name, holder: Name, priority: Priority, preemption: Preemption },
    /// The writer waits for a resource; nobody waits for two.
    #[error("'{writer}' waits for '{resource}' already")]
    WaitsAlready { writer: Name, resource: Name },
    /// The writer would wait for somebody who waits for the writer: each resource of the circle with who holds it.
    #[error("'{writer}' would wait for itself: {}", told(circle))]
    Deadlock { writer: Name, circle: Vec<(Name, Name)> },
    /// The graph has moved on.
    #[error("expected version {}, the graph is at {}", expected.0, current.0)]
    Stale { expected: Version, current: Version },
    /// The reflex to be dismissed has fired or was dismissed.
    #[error("reflex {} is gone", reflex.0)]
    ReflexGone { reflex: ReflexId },
    /// The reflex to be dismissed, or to be registered, is another agent's.
    #[error("'{writer}' cannot act for '{owner}'")]
    NotOwner { writer: Name, owner: Name },
    /// A condition that a new reflex is to keep does not hold.
    #[error("condition {keep} of a new reflex of '{owner}' does not hold")]
    KeepBroken { owner: Name, keep: usize },
    /// A new reflex names a lease that its owner does not hold.
    #[error("'{owner}' does not hold '{resource}'")]
    NotHeld { owner: Name, resource: Name },
    /// A new reflex would take a lease or wait for one; it fires where its owner is dead, and the dead hold nothing.
    #[error("a reflex of '{owner}' would take '{resource}'")]
    ReflexClaims { owner: Name, resource: Name },
    /// What a new reflex would do could not be done.
    #[error("a reflex of '{owner}' could not fire: {error}")]
    ReflexRefused { owner: Name, error: Box<TransactionError> },
}

fn told(circle: &[(Name, Name)]) -> String {
    let step = |(resource, holder): &(Name, Name)| format!("'{resource}' is held by '{holder}'");
    circle.iter().map(step).collect::<Vec<_>>().join(", who waits: ")
}

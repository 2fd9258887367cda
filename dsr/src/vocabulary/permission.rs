//! Permissions: which agent may write which token, and where.
//!
//! The vocabulary lists the agents that may write a token. A permission can fix an end: `speech` may write that a node
//! *is* `speaking`, and nothing else with the label *is*.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{AttributeId, LabelId, TypeId};

/// What can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Token {
    /// Edges with this label. Removing an edge removes its attributes, whatever their permissions.
    Label(LabelId),
    /// This attribute.
    Attribute(AttributeId),
    /// Rigid transforms: `from` is the parent, `to` the child.
    Transform,
    /// Nodes of this type and its subtypes. Removing a node removes its edges and attributes, whatever their
    /// permissions.
    Node(TypeId),
}

/// The nodes at one end of an edge for which a permission holds.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Any node that the signature allows.
    Any,
    /// The node of this name.
    Named(Arc<str>),
    /// Nodes of this type.
    OfType(TypeId),
}

impl End {
    /// The node of this name.
    pub fn named(name: impl Into<Arc<str>>) -> Self {
        Self::Named(name.into())
    }
}

/// A token that an agent may write, and where.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Permission {
    /// The token.
    pub token: Token,
    /// Where it may start; for an attribute of nodes and for nodes, the node itself.
    pub from: End,
    /// Where it may end; [`End::Any`] if the token has one end.
    pub to: End,
}

impl Permission {
    /// The token, at any nodes that its signature allows.
    pub fn anywhere(token: Token) -> Self {
        Self { token, from: End::Any, to: End::Any }
    }

    /// The token between these ends.
    pub fn between(token: Token, from: End, to: End) -> Self {
        Self { token, from, to }
    }
}

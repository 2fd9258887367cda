//! Permissions: which agent may write which token, and where.
//!
//! A token belongs to the agents that the vocabulary names; with an end fixed, an agent owns a label only
//! there: `speech` may say what *is* `speaking`, and nothing else that *is*.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::{NameOf, Vocabulary};
use crate::id::{AttributeId, LabelId, TypeId};

/// What can be written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Token {
    /// Edges with this label. Who may remove an edge may thereby remove its attributes.
    Label(LabelId),
    /// This attribute.
    Attribute(AttributeId),
    /// Rigid transforms: `from` is the parent, `to` the child.
    Transform,
    /// The existence of nodes of this type and its subtypes. Who may remove a node may thereby remove all
    /// that touches it.
    Node(TypeId),
}

/// Which nodes may stand at one end of what is written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum End {
    /// Any that the signature allows.
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

    pub(super) fn admits(&self, vocabulary: &Vocabulary, (name, node_type): (NameOf<'_>, TypeId)) -> bool {
        match self {
            Self::Any => true,
            Self::Named(wanted) => **wanted == *name(),
            Self::OfType(wanted) => vocabulary.is_a(node_type, *wanted),
        }
    }
}

/// One thing that an agent may write.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Permission {
    /// The token.
    pub token: Token,
    /// Where it may start; the holder, for an attribute of nodes or the existence of a node.
    pub from: End,
    /// Where it may end; [`End::Any`] where there is no second end.
    pub to: End,
}

impl Permission {
    /// The token, wherever its signature allows.
    pub fn anywhere(token: Token) -> Self {
        Self { token, from: End::Any, to: End::Any }
    }

    /// The token between these ends.
    pub fn between(token: Token, from: End, to: End) -> Self {
        Self { token, from, to }
    }
}

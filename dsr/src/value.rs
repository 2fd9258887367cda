//! Values of attributes: numbers, text, truth values and references to nodes.
//!
//! A stored number is always finite, so two stored values are equal exactly when their bits are. Deltas, exports and
//! replays agree to the byte because of this.

use std::fmt;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::id::{NodeId, TypeId};
use crate::unit::Unit;

/// What an attribute may hold, as the vocabulary declares it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// A finite number, in the unit of the attribute if it has one.
    Number,
    /// Text.
    Text,
    /// A truth value.
    Bool,
    /// A reference to a node of this type or of a subtype.
    Node(TypeId),
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Number => "number",
            Self::Text => "text",
            Self::Bool => "bool",
            Self::Node(_) => "node",
        })
    }
}

/// A value that an attribute holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Value {
    /// A finite number.
    Number(f64),
    /// Text.
    Text(Arc<str>),
    /// A truth value.
    Bool(bool),
    /// A node. Removing that node removes the attribute.
    Node(NodeId),
}

impl Value {
    /// A text.
    pub fn text(text: impl Into<Arc<str>>) -> Self {
        Self::Text(text.into())
    }

    /// The number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        if let Self::Number(number) = self { Some(*number) } else { None }
    }

    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    /// The truth value, if it is one.
    pub fn as_bool(&self) -> Option<bool> {
        if let Self::Bool(truth) = self { Some(*truth) } else { None }
    }

    /// The node, if it is one.
    pub fn as_node(&self) -> Option<NodeId> {
        if let Self::Node(node) = self { Some(*node) } else { None }
    }

    /// Equal to the bit, so that a delta reports every difference that a comparison of bytes would find.
    pub(crate) fn same(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Number(a), Self::Number(b)) => a.to_bits() == b.to_bits(),
            _ => self == other,
        }
    }
}

/// Names a node in an edit, by id or by name. Only a name can refer to a node that the same transaction adds.
#[derive(Debug, Clone, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NodeRef {
    /// By id.
    Id(NodeId),
    /// By name, which is looked up when the edit is applied.
    Name(Arc<str>),
}

impl fmt::Display for NodeRef {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Id(id) => write!(f, "{id}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

impl From<NodeId> for NodeRef {
    fn from(id: NodeId) -> Self {
        Self::Id(id)
    }
}

impl From<&str> for NodeRef {
    fn from(name: &str) -> Self {
        Self::Name(name.into())
    }
}

impl From<String> for NodeRef {
    fn from(name: String) -> Self {
        Self::Name(name.into())
    }
}

impl From<Arc<str>> for NodeRef {
    fn from(name: Arc<str>) -> Self {
        Self::Name(name)
    }
}

/// A value as an edit gives it: like [`Value`], but a node may be given by name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NewValue {
    /// A number, in the attribute's unit if it has one.
    Number(f64),
    /// A number in a unit; it is converted to the attribute's unit.
    Quantity(f64, Unit),
    /// Text.
    Text(Arc<str>),
    /// A truth value.
    Bool(bool),
    /// A node.
    Node(NodeRef),
}

impl From<(f64, Unit)> for NewValue {
    fn from((number, unit): (f64, Unit)) -> Self {
        Self::Quantity(number, unit)
    }
}

impl From<Value> for NewValue {
    fn from(value: Value) -> Self {
        match value {
            Value::Number(number) => Self::Number(number),
            Value::Text(text) => Self::Text(text),
            Value::Bool(truth) => Self::Bool(truth),
            Value::Node(node) => Self::Node(NodeRef::Id(node)),
        }
    }
}

impl From<f64> for NewValue {
    fn from(number: f64) -> Self {
        Self::Number(number)
    }
}

impl From<bool> for NewValue {
    fn from(truth: bool) -> Self {
        Self::Bool(truth)
    }
}

impl From<&str> for NewValue {
    fn from(text: &str) -> Self {
        Self::Text(text.into())
    }
}

impl From<NodeRef> for NewValue {
    fn from(node: NodeRef) -> Self {
        Self::Node(node)
    }
}

impl From<NodeId> for NewValue {
    fn from(node: NodeId) -> Self {
        Self::Node(NodeRef::Id(node))
    }
}

//! The vocabulary: every token that may stand in the graph, and which agents may write it.
//!
//! Problem: agents that invent terms of their own cannot understand each other; the paper's authors name the missing
//! common vocabulary as the first thing that they could not do. Idea: types in a single-parent hierarchy, labels with
//! the signatures that they allow, attributes with their holder and kind, writers with the tokens that they may write,
//! and exclusive resources. Invariant: a built vocabulary never changes, and every id in it is valid. Cost: `is_a` is
//! two comparisons (types are numbered depth first, so subtypes are an interval); a permission is one hash look-up.
//!
//! Every vocabulary has the types `object`, `agent` and `resource`, the agent `dsr`, and two labels from agent to
//! resource: `holds` with its attributes `priority`, `yields` and `claim`, and `awaits` with `awaits_priority`,
//! `awaits_yields` and `asked`.

mod builder;
mod permission;
mod plain;

use std::sync::Arc;

use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

pub use self::builder::{VocabularyBuilder, VocabularyError};
pub use self::permission::{End, Permission, Token};
use crate::id::{AgentId, AttributeId, LabelId, NodeId, ResourceId, TypeId};
use crate::unit::Unit;
use crate::value::Kind;

/// Whether nodes of a type may take part in the geometric quiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Nature {
    /// May not have a pose, unless an ancestor of the type is geometric.
    Symbolic,
    /// May have a pose, and so may nodes of every subtype.
    Geometric,
}

/// The types of the two ends that a label may connect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Signature {
    /// Type of the start, or a supertype of it.
    pub from: TypeId,
    /// Type of the end, or a supertype of it.
    pub to: TypeId,
}

/// The most edges of a label that a node may have; `None` for no limit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Degree {
    /// Outgoing edges.
    pub leaving: Option<u32>,
    /// Incoming edges.
    pub reaching: Option<u32>,
}

/// What carries an attribute, by type.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HolderType {
    /// Nodes of this type and its subtypes.
    Node(TypeId),
    /// Edges with this label whose ends fit the signature.
    Edge {
        /// The label.
        label: LabelId,
        /// The ends.
        signature: Signature,
    },
}

impl HolderType {
    pub(crate) fn takes_node(self, node_type: TypeId, vocabulary: &Vocabulary) -> bool {
        matches!(self, Self::Node(on) if vocabulary.is_a(node_type, on))
    }

    pub(crate) fn takes_edge(
        self,
        label: LabelId,
        (from, to): (TypeId, TypeId),
        vocabulary: &Vocabulary,
    ) -> bool {
        matches!(self, Self::Edge { label: on, signature }
            if on == label && vocabulary.is_a(from, signature.from) && vocabulary.is_a(to, signature.to))
    }
}

#[derive(Debug)]
struct NodeType {
    name: Arc<str>,
    parent: Option<TypeId>,
    nature: Nature,
    /// Depth-first number of this type; its subtypes are numbered `enter .. enter + size`.
    enter: u32,
    size: u32,
}

#[derive(Debug)]
struct Label {
    name: Arc<str>,
    signatures: Vec<Signature>,
    degree: Degree,
}

#[derive(Debug)]
struct Attribute {
    name: Arc<str>,
    holder: HolderType,
    kind: Kind,
    unit: Option<Unit>,
}

/// Every token of the graph. Made by a [`VocabularyBuilder`], shared behind an `Arc`, never changed.
#[derive(Debug)]
pub struct Vocabulary {
    types: Vec<NodeType>,
    labels: Vec<Label>,
    attributes: Vec<Attribute>,
    agents: Vec<Arc<str>>,
    resources: Vec<Arc<str>>,
    /// Whether any label has a degree.
    limited: bool,
    type_names: FxHashMap<Arc<str>, TypeId>,
    label_names: FxHashMap<Arc<str>, LabelId>,
    attribute_names: FxHashMap<Arc<str>, AttributeId>,
    agent_names: FxHashMap<Arc<str>, AgentId>,
    resource_names: FxHashMap<Arc<str>, ResourceId>,
    permissions: FxHashMap<(AgentId, Token), Vec<(End, End)>>,
}

impl Vocabulary {
    /// The type of that name.
    pub fn node_type(&self, name: &str) -> Option<TypeId> {
        self.type_names.get(name).copied()
    }

    /// The label of that name.
    pub fn label(&self, name: &str) -> Option<LabelId> {
        self.label_names.get(name).copied()
    }

    /// The attribute of that name.
    pub fn attribute(&self, name: &str) -> Option<AttributeId> {
        self.attribute_names.get(name).copied()
    }

    /// The agent of that name.
    pub fn agent(&self, name: &str) -> Option<AgentId> {
        self.agent_names.get(name).copied()
    }

    /// The resource of that name.
    pub fn resource(&self, name: &str) -> Option<ResourceId> {
        self.resource_names.get(name).copied()
    }

    /// The name of a type; `None` if the id is of another vocabulary.
    pub fn type_name(&self, id: TypeId) -> Option<&Arc<str>> {
        self.types.get(id.index()).map(|entry| &entry.name)
    }

    /// The name of a label.
    pub fn label_name(&self, id: LabelId) -> Option<&Arc<str>> {
        self.labels.get(id.index()).map(|entry| &entry.name)
    }

    /// The name of an attribute.
    pub fn attribute_name(&self, id: AttributeId) -> Option<&Arc<str>> {
        self.attributes.get(id.index()).map(|entry| &entry.name)
    }

    /// The name of an agent.
    pub fn agent_name(&self, id: AgentId) -> Option<&Arc<str>> {
        self.agents.get(id.index())
    }

    /// The name of a resource.
    pub(crate) fn resource_name(&self, id: ResourceId) -> Option<&Arc<str>> {
        self.resources.get(id.index())
    }

    /// All types, parents before children.
    pub fn types(&self) -> impl Iterator<Item = TypeId> + '_ {
        (0..self.types.len()).map(TypeId::at)
    }

    /// All labels.
    pub fn labels(&self) -> impl Iterator<Item = LabelId> + '_ {
        (0..self.labels.len()).map(LabelId::at)
    }

    /// All attributes.
    pub fn attributes(&self) -> impl Iterator<Item = AttributeId> + '_ {
        (0..self.attributes.len()).map(AttributeId::at)
    }

    /// All agents.
    pub fn agents(&self) -> impl Iterator<Item = AgentId> + '_ {
        (0..self.agents.len()).map(AgentId::at)
    }

    /// All resources.
    pub fn resources(&self) -> impl Iterator<Item = ResourceId> + '_ {
        (0..self.resources.len()).map(ResourceId::at)
    }

    /// The parent of a type; `None` for `object` and for foreign ids.
    pub fn parent(&self, id: TypeId) -> Option<TypeId> {
        self.types.get(id.index())?.parent
    }

    /// Whether every `sub` is a `sup`. False for foreign ids.
    pub fn is_a(&self, sub: TypeId, sup: TypeId) -> bool {
        match (self.types.get(sub.index()), self.types.get(sup.index())) {
            (Some(sub), Some(sup)) => sub.enter.wrapping_sub(sup.enter) < sup.size,
            _ => false,
        }
    }

    /// Whether a node can be of both types. In a tree of types, one must then be a subtype of the other.
    pub(crate) fn overlap(&self, a: TypeId, b: TypeId) -> bool {
        self.is_a(a, b) || self.is_a(b, a)
    }

    /// Whether nodes of this type may take part in the geometric quiver.
    pub(crate) fn nature(&self, id: TypeId) -> Option<Nature> {
        self.types.get(id.index()).map(|entry| entry.nature)
    }

    /// The signatures of a label; empty for foreign ids.
    pub fn signatures(&self, id: LabelId) -> &[Signature] {
        self.labels.get(id.index()).map_or(&[], |entry| &entry.signatures)
    }

    /// Whether the label may go from a node of type `from` to a node of type `to`.
    pub(crate) fn allows(&self, label: LabelId, from: TypeId, to: TypeId) -> bool {
        self.signatures(label).iter().any(|s| self.is_a(from, s.from) && self.is_a(to, s.to))
    }

    /// Whether only the graph itself writes the label.
    pub(crate) fn is_reserved(label: LabelId) -> bool {
        label == LabelId::HOLDS || label == LabelId::AWAITS
    }

    /// What carries the attribute.
    pub fn holder(&self, id: AttributeId) -> Option<HolderType> {
        self.attributes.get(id.index()).map(|entry| entry.holder)
    }

    /// The kind of value that the attribute holds.
    pub fn kind(&self, id: AttributeId) -> Option<Kind> {
        self.attributes.get(id.index()).map(|entry| entry.kind)
    }

    /// The most edges of the label that a node may have.
    pub(crate) fn degree(&self, label: LabelId) -> Degree {
        self.labels.get(label.index()).map_or(Degree::default(), |entry| entry.degree)
    }

    /// Whether any label is limited.
    pub(crate) fn has_limits(&self) -> bool {
        self.limited
    }

    /// The unit of the attribute, if it has one.
    pub fn unit(&self, id: AttributeId) -> Option<Unit> {
        self.attributes.get(id.index())?.unit
    }

    /// The node that stands for an agent in every graph of this vocabulary.
    pub(crate) fn agent_node(&self, id: AgentId) -> Option<NodeId> {
        (id.index() < self.agents.len()).then_some(NodeId(id.0))
    }

    /// The agent for which a node stands.
    pub(crate) fn agent_of(&self, node: NodeId) -> Option<AgentId> {
        (node.index() < self.agents.len()).then_some(AgentId(node.0))
    }

    /// The node that stands for a resource in every graph of this vocabulary.
    pub fn resource_node(&self, id: ResourceId) -> Option<NodeId> {
        (id.index() < self.resources.len()).then(|| NodeId::at(self.agents.len() + id.index()))
    }

    /// The resource for which a node stands.
    pub(crate) fn resource_of(&self, node: NodeId) -> Option<ResourceId> {
        let index = node.index().checked_sub(self.agents.len())?;
        (index < self.resources.len()).then(|| ResourceId::at(index))
    }

    /// Whether `writer` may write `token` between nodes of these names and types. For an attribute or the
    /// existence of a node, `from` is the node itself and `to` is `None`.
    /// A name is looked up only if a permission is for a named node.
    pub(crate) fn permits(
        &self,
        writer: AgentId,
        token: Token,
        from: (NameOf<'_>, TypeId),
        to: Option<(NameOf<'_>, TypeId)>,
    ) -> bool {
        if writer == AgentId::DSR {
            return true;
        }
        self.permissions.get(&(writer, token)).is_some_and(|ends| {
            ends.iter().any(|(first, second)| {
                self.admits(first, from)
                    && match to {
                        Some(to) => self.admits(second, to),
                        None => *second == End::Any,
                    }
            })
        })
    }

    fn admits(&self, end: &End, (name, node_type): (NameOf<'_>, TypeId)) -> bool {
        match end {
            End::Any => true,
            End::Named(wanted) => **wanted == *name(),
            End::OfType(wanted) => self.is_a(node_type, *wanted),
        }
    }
}

/// Looks up the name of a node.
pub(crate) type NameOf<'a> = &'a dyn Fn() -> &'a str;

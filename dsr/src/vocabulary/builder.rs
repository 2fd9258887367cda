//! Building a vocabulary: names in, valid ids out.
//!
//! A type is declared after its parent, so the hierarchy cannot have a cycle. Declaring a label again adds a signature.
//! Agents and resources become nodes of every graph, so they share one name space.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::{
    Attribute, Degree, HolderType, Label, Nature, NodeType, Permission, Signature, Token, Vocabulary,
};
use crate::id::{AgentId, AttributeId, LabelId, ResourceId, TypeId};
use crate::unit::Unit;
use crate::value::Kind;

/// Why a declaration is rejected.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum VocabularyError {
    /// A name is empty.
    #[error("a name is empty")]
    EmptyName,
    /// The type has been declared before.
    #[error("type '{name}' is declared twice")]
    DuplicateType {
        /// The type.
        name: Arc<str>,
    },
    /// The attribute has been declared before.
    #[error("attribute '{name}' is declared twice")]
    DuplicateAttribute {
        /// The attribute.
        name: Arc<str>,
    },
    /// An agent or a resource has that name.
    #[error("'{name}' already names an agent or a resource")]
    DuplicateNode {
        /// The name.
        name: Arc<str>,
    },
    /// The id belongs to another vocabulary.
    #[error("no type {id} here")]
    UnknownType {
        /// The id.
        id: TypeId,
    },
    /// The id belongs to another vocabulary.
    #[error("no label {id} here")]
    UnknownLabel {
        /// The id.
        id: LabelId,
    },
    /// The id belongs to another vocabulary.
    #[error("no attribute {id} here")]
    UnknownAttribute {
        /// The id.
        id: AttributeId,
    },
    /// The id belongs to another vocabulary.
    #[error("no agent {id} here")]
    UnknownAgent {
        /// The id.
        id: AgentId,
    },
    /// The labels `holds` and `awaits` and their attributes: only claims write them.
    #[error("'{name}' is reserved for leases")]
    Reserved {
        /// The token.
        name: Arc<str>,
    },
    /// A unit for an attribute that does not hold numbers.
    #[error("attribute '{name}' is no number and has no unit")]
    NotMeasured {
        /// The attribute.
        name: Arc<str>,
    },
    /// An attribute of edges that the label does not allow.
    #[error("attribute '{attribute}': label '{label}' does not go from '{from}' to '{to}'")]
    NoSuchSignature {
        /// The attribute.
        attribute: Arc<str>,
        /// The label.
        label: Arc<str>,
        /// The type of the start.
        from: Arc<str>,
        /// The type of the end.
        to: Arc<str>,
    },
}

/// Declares tokens one by one.
#[derive(Debug)]
pub struct VocabularyBuilder {
    /// The vocabulary so far; its permissions are filled in at the end.
    made: Vocabulary,
    permissions: Vec<(AgentId, Permission)>,
}

impl Default for VocabularyBuilder {
    fn default() -> Self {
        Self::new()
    }
}

impl VocabularyBuilder {
    /// A vocabulary with only the built-in tokens.
    pub fn new() -> Self {
        let mut new = Self {
            made: Vocabulary {
                types: Vec::new(),
                labels: Vec::new(),
                attributes: Vec::new(),
                agents: Vec::new(),
                resources: Vec::new(),
                limited: false,
                type_names: FxHashMap::default(),
                label_names: FxHashMap::default(),
                attribute_names: FxHashMap::default(),
                agent_names: FxHashMap::default(),
                resource_names: FxHashMap::default(),
                permissions: FxHashMap::default(),
            },
            permissions: Vec::new(),
        };
        for (name, parent) in
            [("object", None), ("agent", Some(TypeId::OBJECT)), ("resource", Some(TypeId::OBJECT))]
        {
            new.add_type(name.into(), parent, Nature::Symbolic);
        }
        let signature = Signature { from: TypeId::AGENT, to: TypeId::RESOURCE };
        for (name, label, attributes) in [
            ("holds", LabelId::HOLDS, ["priority", "yields", "claim"]),
            ("awaits", LabelId::AWAITS, ["awaits_priority", "awaits_yields", "asked"]),
        ] {
            new.made.labels.push(Label {
                name: name.into(),
                signatures: vec![signature],
                degree: Degree::default(),
            });
            new.made.label_names.insert(name.into(), label);
            let holder = HolderType::Edge { label, signature };
            for (attribute, kind) in attributes.into_iter().zip([Kind::Number, Kind::Bool, Kind::Number]) {
                new.add_attribute(attribute.into(), holder, kind);
            }
        }
        new.made.agents.push("dsr".into());
        new.made.agent_names.insert("dsr".into(), AgentId::DSR);
        new
    }

    /// Declares a type below `parent` (`None`: below `object`). A subtype of a geometric type is geometric.
    pub fn node_type(
        &mut self,
        name: &str,
        parent: Option<TypeId>,
        nature: Nature,
    ) -> Result<TypeId, VocabularyError> {
        let name = named(name)?;
        if self.made.type_names.contains_key(&name) {
            return Err(VocabularyError::DuplicateType { name });
        }
        let parent = parent.unwrap_or(TypeId::OBJECT);
        self.known_type(parent)?;
        let nature = if self.made.types[parent.index()].nature == Nature::Geometric {
            Nature::Geometric
        } else {
            nature
        };
        Ok(self.add_type(name, Some(parent), nature))
    }

    /// Declares a label, or another signature of it.
    pub fn label(&mut self, name: &str, from: TypeId, to: TypeId) -> Result<LabelId, VocabularyError> {
        let name = named(name)?;
        self.known_type(from)?;
        self.known_type(to)?;
        let id = match self.made.label_names.get(&name) {
            Some(&id) if Vocabulary::is_reserved(id) => return Err(VocabularyError::Reserved { name }),
            Some(&id) => id,
            None => {
                let id = LabelId::at(self.made.labels.len());
                self.made.labels.push(Label {
                    name: name.clone(),
                    signatures: Vec::new(),
                    degree: Degree::default(),
                });
                self.made.label_names.insert(name, id);
                id
            }
        };
        let signature = Signature { from, to };
        let signatures = &mut self.made.labels[id.index()].signatures;
        if !signatures.contains(&signature) {
            signatures.push(signature);
        }
        Ok(id)
    }

    /// Declares an attribute of the nodes of a type.
    pub fn attribute_on_node(
        &mut self,
        name: &str,
        holder: TypeId,
        kind: Kind,
    ) -> Result<AttributeId, VocabularyError> {
        self.known_type(holder)?;
        self.attribute(name, HolderType::Node(holder), kind)
    }

    /// Declares an attribute of the edges with `label` from a `from` to a `to`, which the label must allow.
    pub fn attribute_on_edge(
        &mut self,
        name: &str,
        label: LabelId,
        (from, to): (TypeId, TypeId),
        kind: Kind,
    ) -> Result<AttributeId, VocabularyError> {
        let name = named(name)?;
        self.known_type(from)?;
        self.known_type(to)?;
        let entry = self.made.labels.get(label.index()).ok_or(VocabularyError::UnknownLabel { id: label })?;
        if Vocabulary::is_reserved(label) {
            return Err(VocabularyError::Reserved { name });
        }
        let fits = |s: &Signature| self.descends(from, s.from) && self.descends(to, s.to);
        if !entry.signatures.iter().any(fits) {
            return Err(VocabularyError::NoSuchSignature {
                attribute: name,
                label: entry.name.clone(),
                from: self.made.types[from.index()].name.clone(),
                to: self.made.types[to.index()].name.clone(),
            });
        }
        self.attribute(&name, HolderType::Edge { label, signature: Signature { from, to } }, kind)
    }

    /// Limits the edges of a label at a node: a person is in one place, a robot has two hands.
    pub fn limit(&mut self, label: LabelId, degree: Degree) -> Result<(), VocabularyError> {
        let entry =
            self.made.labels.get_mut(label.index()).ok_or(VocabularyError::UnknownLabel { id: label })?;
        if Vocabulary::is_reserved(label) {
            return Err(VocabularyError::Reserved { name: entry.name.clone() });
        }
        entry.degree = degree;
        self.made.limited = self.made.labels.iter().any(|label| label.degree != Degree::default());
        Ok(())
    }

    /// Sets the unit of a numeric attribute.
    pub fn measured_in(&mut self, attribute: AttributeId, unit: Unit) -> Result<(), VocabularyError> {
        let id = attribute;
        let entry =
            self.made.attributes.get_mut(id.index()).ok_or(VocabularyError::UnknownAttribute { id })?;
        if entry.kind != Kind::Number {
            return Err(VocabularyError::NotMeasured { name: entry.name.clone() });
        }
        if id.index() <= AttributeId::ASKED.index() {
            return Err(VocabularyError::Reserved { name: entry.name.clone() });
        }
        entry.unit = Some(unit);
        Ok(())
    }

    /// Declares a writer. It becomes a node of type `agent` in every graph.
    pub fn agent(&mut self, name: &str) -> Result<AgentId, VocabularyError> {
        let name = self.free_node(name)?;
        let id = AgentId::at(self.made.agents.len());
        self.made.agents.push(name.clone());
        self.made.agent_names.insert(name, id);
        Ok(id)
    }

    /// Declares an exclusive resource. It becomes a node of type `resource` in every graph.
    pub fn resource(&mut self, name: &str) -> Result<ResourceId, VocabularyError> {
        let name = self.free_node(name)?;
        let id = ResourceId::at(self.made.resources.len());
        self.made.resources.push(name.clone());
        self.made.resource_names.insert(name, id);
        Ok(id)
    }

    /// Permits an agent to write a token. Without any permission an agent may only claim and release.
    pub fn permit(&mut self, agent: AgentId, permission: Permission) -> Result<(), VocabularyError> {
        if agent.index() >= self.made.agents.len() {
            return Err(VocabularyError::UnknownAgent { id: agent });
        }
        match permission.token {
            Token::Label(id) if Vocabulary::is_reserved(id) => {
                return Err(VocabularyError::Reserved { name: self.made.labels[id.index()].name.clone() });
            }
            Token::Label(id) if id.index() >= self.made.labels.len() => {
                return Err(VocabularyError::UnknownLabel { id });
            }
            Token::Attribute(id) => match self.made.attributes.get(id.index()) {
                None => return Err(VocabularyError::UnknownAttribute { id }),
                Some(entry) if id.index() <= AttributeId::ASKED.index() => {
                    return Err(VocabularyError::Reserved { name: entry.name.clone() });
                }
                Some(_) => {}
            },
            Token::Node(id) => self.known_type(id)?,
            Token::Label(_) | Token::Transform => {}
        }
        self.permissions.push((agent, permission));
        Ok(())
    }

    /// Completes the vocabulary.
    pub fn build(self) -> Arc<Vocabulary> {
        Arc::new(self.close())
    }

    pub(super) fn close(mut self) -> Vocabulary {
        self.number_types();
        let mut permissions: FxHashMap<_, Vec<_>> = FxHashMap::default();
        for (agent, Permission { token, from, to }) in &self.permissions {
            let tokens = match *token {
                // An agent that may add nodes of a type may add nodes of its subtypes. The subtypes are listed here, so
                // that a check is one look-up.
                Token::Node(id) => (0..self.made.types.len())
                    .map(TypeId::at)
                    .filter(|&sub| self.descends(sub, id))
                    .map(Token::Node)
                    .collect(),
                other => vec![other],
            };
            for token in tokens {
                let ends = permissions.entry((*agent, token)).or_default();
                if !ends.iter().any(|(a, b)| a == from && b == to) {
                    ends.push((from.clone(), to.clone()));
                }
            }
        }
        Vocabulary { permissions, ..self.made }
    }

    fn add_type(&mut self, name: Arc<str>, parent: Option<TypeId>, nature: Nature) -> TypeId {
        let id = TypeId::at(self.made.types.len());
        self.made.type_names.insert(name.clone(), id);
        self.made.types.push(NodeType { name, parent, nature, enter: 0, size: 1 });
        id
    }

    fn attribute(
        &mut self,
        name: &str,
        holder: HolderType,
        kind: Kind,
    ) -> Result<AttributeId, VocabularyError> {
        let name = named(name)?;
        if self.made.attribute_names.contains_key(&name) {
            return Err(VocabularyError::DuplicateAttribute { name });
        }
        if let Kind::Node(target) = kind {
            self.known_type(target)?;
        }
        Ok(self.add_attribute(name, holder, kind))
    }

    fn add_attribute(&mut self, name: Arc<str>, holder: HolderType, kind: Kind) -> AttributeId {
        let id = AttributeId::at(self.made.attributes.len());
        self.made.attribute_names.insert(name.clone(), id);
        self.made.attributes.push(Attribute { name, holder, kind, unit: None });
        id
    }

    fn known_type(&self, id: TypeId) -> Result<(), VocabularyError> {
        if id.index() < self.made.types.len() { Ok(()) } else { Err(VocabularyError::UnknownType { id }) }
    }

    fn free_node(&self, name: &str) -> Result<Arc<str>, VocabularyError> {
        let name = named(name)?;
        if self.made.agent_names.contains_key(&name) || self.made.resource_names.contains_key(&name) {
            return Err(VocabularyError::DuplicateNode { name });
        }
        Ok(name)
    }

    fn descends(&self, sub: TypeId, sup: TypeId) -> bool {
        let mut at = Some(sub);
        while let Some(id) = at {
            if id == sup {
                return true;
            }
            at = self.made.types[id.index()].parent;
        }
        false
    }

    /// Numbers the types depth first: parents precede children in the table, so one pass up sums the sizes and
    /// one pass down hands each child the next free interval of its parent.
    fn number_types(&mut self) {
        for index in (1..self.made.types.len()).rev() {
            if let Some(parent) = self.made.types[index].parent {
                self.made.types[parent.index()].size += self.made.types[index].size;
            }
        }
        let mut free = vec![1; self.made.types.len()];
        for index in 1..self.made.types.len() {
            if let Some(parent) = self.made.types[index].parent {
                let enter = free[parent.index()];
                free[parent.index()] += self.made.types[index].size;
                self.made.types[index].enter = enter;
                free[index] = enter + 1;
            }
        }
    }
}

fn named(name: &str) -> Result<Arc<str>, VocabularyError> {
    if name.is_empty() { Err(VocabularyError::EmptyName) } else { Ok(name.into()) }
}

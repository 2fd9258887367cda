//! A vocabulary as plain data: the beginning of a journal, which can so be read without the program that wrote it.
//!
//! The lists are in the order of the ids, without the built-in tokens. Invariant: reading declares everything again
//! through the builder, so a vocabulary that was read is checked and has the ids that it had.

use std::sync::Arc;

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{
    Degree, HolderType, Nature, Permission, Signature, Vocabulary, VocabularyBuilder, VocabularyError,
};
use crate::id::{AgentId, AttributeId, LabelId, TypeId};
use crate::unit::Unit;
use crate::value::Kind;

#[derive(Serialize, Deserialize)]
struct Plain {
    types: Vec<PlainType>,
    labels: Vec<PlainLabel>,
    attributes: Vec<PlainAttribute>,
    agents: Vec<Arc<str>>,
    resources: Vec<Arc<str>>,
    permissions: Vec<(AgentId, Permission)>,
}

#[derive(Serialize, Deserialize)]
struct PlainType {
    name: Arc<str>,
    parent: TypeId,
    nature: Nature,
}

#[derive(Serialize, Deserialize)]
struct PlainLabel {
    name: Arc<str>,
    signatures: Vec<Signature>,
    degree: Degree,
}

#[derive(Serialize, Deserialize)]
struct PlainAttribute {
    name: Arc<str>,
    holder: HolderType,
    kind: Kind,
    unit: Option<Unit>,
}

impl Plain {
    fn of(vocabulary: &Vocabulary) -> Self {
        let mut permissions: Vec<_> = vocabulary.permissions.iter().collect();
        permissions.sort_by_key(|(key, _)| **key);
        let permissions = permissions.into_iter().flat_map(|(&(agent, token), ends)| {
            ends.iter().map(move |(from, to)| (agent, Permission::between(token, from.clone(), to.clone())))
        });
        let types = vocabulary.types.iter().skip(TypeId::RESOURCE.index() + 1);
        let labels = vocabulary.labels.iter().skip(LabelId::AWAITS.index() + 1);
        let attributes = vocabulary.attributes.iter().skip(AttributeId::ASKED.index() + 1);
        Self {
            types: types
                .map(|entry| PlainType {
                    name: entry.name.clone(),
                    parent: entry.parent.unwrap_or(TypeId::OBJECT),
                    nature: entry.nature,
                })
                .collect(),
            labels: labels
                .map(|entry| PlainLabel {
                    name: entry.name.clone(),
                    signatures: entry.signatures.clone(),
                    degree: entry.degree,
                })
                .collect(),
            attributes: attributes
                .map(|entry| PlainAttribute {
                    name: entry.name.clone(),
                    holder: entry.holder,
                    kind: entry.kind,
                    unit: entry.unit,
                })
                .collect(),
            agents: vocabulary.agents.iter().skip(AgentId::DSR.index() + 1).cloned().collect(),
            resources: vocabulary.resources.clone(),
            permissions: permissions.collect(),
        }
    }

    fn build(&self) -> Result<Vocabulary, VocabularyError> {
        let mut builder = VocabularyBuilder::new();
        for PlainType { name, parent, nature } in &self.types {
            builder.node_type(name, Some(*parent), *nature)?;
        }
        for PlainLabel { name, signatures, degree } in &self.labels {
            for Signature { from, to } in signatures {
                let label = builder.label(name, *from, *to)?;
                builder.limit(label, *degree)?;
            }
        }
        for PlainAttribute { name, holder, kind, unit } in &self.attributes {
            let id = match *holder {
                HolderType::Node(on) => builder.attribute_on_node(name, on, *kind)?,
                HolderType::Edge { label, signature: Signature { from, to } } => {
                    builder.attribute_on_edge(name, label, (from, to), *kind)?
                }
            };
            if let Some(unit) = unit {
                builder.measured_in(id, *unit)?;
            }
        }
        for name in &self.agents {
            builder.agent(name)?;
        }
        for name in &self.resources {
            builder.resource(name)?;
        }
        for (agent, permission) in &self.permissions {
            builder.permit(*agent, permission.clone())?;
        }
        Ok(builder.close())
    }
}

impl Serialize for Vocabulary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Plain::of(self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Vocabulary {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Plain::deserialize(deserializer)?.build().map_err(D::Error::custom)
    }
}

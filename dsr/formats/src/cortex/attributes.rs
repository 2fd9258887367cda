//! The attributes of the file as attributes of a vocabulary.
//!
//! Problem: cortex puts attributes of any name on any holder, with any value; ours are declared once, with holder and
//! kind, and share one name space. Idea: an attribute is identified by its holder, its name in the file, its position
//! in a list and its kind. Only then each one gets a name, those that can keep their own name first.

use std::collections::{BTreeMap, BTreeSet};

use dsr::{AttributeId, Kind, NewValue, TypeId, VocabularyBuilder};

use super::error::CortexError;
use super::kinds::Kinds;
use super::names::Names;
use super::symbols::{Edge, Found, Node};

/// The holder of an attribute.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    Nodes,
    /// The links of a label.
    Links(String),
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sort {
    Number,
    Bool,
    Text,
}

impl Sort {
    fn of(value: &NewValue) -> Self {
        match value {
            NewValue::Number(_) | NewValue::Quantity(..) => Self::Number,
            NewValue::Bool(_) => Self::Bool,
            NewValue::Text(_) | NewValue::Node(_) => Self::Text,
        }
    }

    fn word(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Bool => "bool",
            Self::Text => "text",
        }
    }

    fn kind(self) -> Kind {
        match self {
            Self::Number => Kind::Number,
            Self::Bool => Kind::Bool,
            Self::Text => Kind::Text,
        }
    }
}

/// An attribute without its kind.
type Stem = (Place, String, Option<usize>);

/// The types on which an attribute occurs.
#[derive(Default)]
struct Uses {
    nodes: BTreeSet<TypeId>,
    ends: BTreeSet<(TypeId, TypeId)>,
}

/// The attributes that a file uses.
pub(super) struct Attributes(BTreeMap<(Stem, Sort), AttributeId>);

impl Attributes {
    pub(super) fn on_node(&self, found: &Found) -> Option<AttributeId> {
        self.0.get(&(stem(Place::Nodes, found), Sort::of(&found.value))).copied()
    }

    pub(super) fn on_edge(&self, label: &str, found: &Found) -> Option<AttributeId> {
        self.0.get(&(stem(Place::Links(label.to_owned()), found), Sort::of(&found.value))).copied()
    }

    /// Declares the attributes that the file uses.
    pub(super) fn declare(
        builder: &mut VocabularyBuilder,
        (nodes, edges): (&[Node], &[Edge]),
        kinds: &Kinds,
        names: &mut Names,
        notes: &mut Vec<String>,
    ) -> Result<Self, CortexError> {
        let mut uses: BTreeMap<(Stem, Sort), Uses> = BTreeMap::new();
        for node in nodes {
            for found in &node.values {
                let uses = uses.entry((stem(Place::Nodes, found), Sort::of(&found.value))).or_default();
                uses.nodes.insert(kinds.types[&node.kind]);
            }
        }
        for edge in edges {
            let ends = [edge.from, edge.to].map(|at| kinds.types[&nodes[at].kind]);
            for found in &edge.values {
                let place = Place::Links(edge.label.clone());
                let uses = uses.entry((stem(place, found), Sort::of(&found.value))).or_default();
                uses.ends.insert(ends.into());
            }
        }
        let mut sorts: BTreeMap<&Stem, usize> = BTreeMap::new();
        uses.keys().for_each(|(stem, _)| *sorts.entry(stem).or_default() += 1);
        // A name that is composed (because of several kinds, a link or a list) gives way to one that is not.
        let is_made = |stem: &Stem| sorts[stem] > 1 || stem.0 != Place::Nodes || stem.2.is_some();
        let mut ordered: Vec<_> = uses.iter().collect();
        ordered.sort_by_key(|((stem, _), _)| is_made(stem));

        let mut declared = BTreeMap::new();
        for ((stem, sort), uses) in ordered {
            let (place, name, at) = stem;
            let mut wanted = match place {
                Place::Nodes => name.clone(),
                Place::Links(label) => format!("{}.{name}", kinds.label_names[label]),
            };
            if let Some(at) = at {
                wanted += &format!("_{at}");
            }
            if sorts[stem] > 1 {
                wanted += &format!(".{}", sort.word());
            }
            let unique = names.give(&wanted, notes);
            let id = match place {
                Place::Nodes => builder.attribute_on_node(
                    &unique,
                    only(&uses.nodes).unwrap_or(TypeId::OBJECT),
                    sort.kind(),
                )?,
                Place::Links(label) => {
                    let ends = only(&uses.ends);
                    if ends.is_none() {
                        // The attribute is on edges between several types, so the label must allow all of them.
                        builder.label(&kinds.label_names[label], TypeId::OBJECT, TypeId::OBJECT)?;
                    }
                    let ends = ends.unwrap_or((TypeId::OBJECT, TypeId::OBJECT));
                    builder.attribute_on_edge(&unique, kinds.labels[label], ends, sort.kind())?
                }
            };
            declared.insert((stem.clone(), *sort), id);
        }
        Ok(Self(declared))
    }
}

fn stem(place: Place, found: &Found) -> Stem {
    (place, found.name.clone(), found.at)
}

fn only<T: Copy + Ord>(set: &BTreeSet<T>) -> Option<T> {
    set.first().copied().filter(|_| set.len() == 1)
}

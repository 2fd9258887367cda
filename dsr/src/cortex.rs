//! Worlds of RoboComp's cortex as graphs of ours: its JSON files with `DSRModel` and `symbols`.
//!
//! Problem: their types, labels and attributes are whatever the file has; ours are declared. Idea: the dictionary is what
//! the file uses. Node types stand below `object`, geometric where an `RT` link touches one; a label goes between the
//! types that it goes between; an attribute sits on the one type that has it, or on `object`. Lists of numbers become
//! one attribute each (`size_0`, `size_1` …), since our attributes hold one value. An `RT` link is a transform: translation
//! in the file's unit, rotation by the angles about x, y and z as `Rx · Ry · Rz`, the newest of its ring where it keeps
//! one. What cannot be taken is in the notes, with the reason.
//!
//! Source: the format as cortex's `api/dsr_utils.cpp` reads it and `api/dsr_rt_api.cpp` means it.

use std::collections::{BTreeMap, BTreeSet};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use serde::{Deserialize, Serialize};

use crate::dictionary::{Dictionary, DictionaryBuilder, DictionaryError, Nature};
use crate::graph::Graph;
use crate::id::{AgentId, AttributeId, LabelId, Time, TypeId};
use crate::transaction::{HolderRef, Transaction, TransactionError};
use crate::value::{Kind, NewValue};

/// A file of cortex.
#[derive(Debug, Clone, Deserialize, Serialize)]
pub struct CortexWorld {
    #[serde(rename = "DSRModel")]
    model: Model,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
struct Model {
    symbols: BTreeMap<String, Symbol>,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
struct Symbol {
    id: Number,
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    name: String,
    #[serde(default)]
    attribute: BTreeMap<String, Content>,
    #[serde(default)]
    links: Vec<Link>,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
struct Link {
    src: Number,
    dst: Number,
    label: String,
    #[serde(default, rename = "linkAttribute")]
    attribute: BTreeMap<String, Content>,
}

/// A 64-bit number, which they write as a string.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Deserialize, Serialize)]
#[serde(untagged)]
enum Number {
    Plain(u64),
    Quoted(String),
}

impl Number {
    fn text(&self) -> String {
        match self {
            Self::Plain(number) => number.to_string(),
            Self::Quoted(text) => text.clone(),
        }
    }
}

/// A value with the number of its type.
#[derive(Debug, Clone, Deserialize, Serialize)]
struct Content {
    #[serde(rename = "type")]
    kind: u32,
    value: Plain,
}

#[derive(Debug, Clone, Deserialize, Serialize)]
#[serde(untagged)]
enum Plain {
    Bool(bool),
    Number(f64),
    Text(String),
    List(Vec<Plain>),
    Nothing(Option<()>),
}

impl Plain {
    fn number(&self) -> Option<f64> {
        let number = match self {
            Self::Number(number) => Some(*number),
            // They write a comma where the locale has one.
            Self::Text(text) => text.replace(',', ".").parse().ok(),
            Self::Bool(_) | Self::List(_) | Self::Nothing(_) => None,
        };
        number.filter(|number: &f64| number.is_finite())
    }

    fn numbers(&self) -> Option<Vec<f64>> {
        if let Self::List(list) = self { list.iter().map(Self::number).collect() } else { None }
    }
}

/// The unit of the file's translations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum CortexUnit {
    /// RoboComp's own.
    #[default]
    Millimetres,
    /// Some files'.
    Metres,
}

/// A world that was taken over.
#[derive(Debug)]
pub struct Imported {
    /// The graph, at version 1.
    pub graph: Graph,
    /// What was left out or renamed, and why.
    pub notes: Vec<String>,
}

/// Why a file is no world of ours.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum CortexError {
    /// Two symbols with one id.
    #[error("two symbols have the id {id}")]
    SameId { id: String },
    /// A link to or from nothing.
    #[error("link `{label}` from {src} to {dst}: no symbol has the id {missing}")]
    NoSymbol { label: String, src: String, dst: String, missing: String },
    /// An RT link without three numbers each.
    #[error("link `RT` from `{parent}` to `{child}` has no translation and rotation of three numbers")]
    NoPose { parent: String, child: String },
    /// Tokens that no dictionary has.
    #[error(transparent)]
    Dictionary(#[from] DictionaryError),
    /// Not a graph that keeps the invariants: a second root, a cycle, a node twice.
    #[error(transparent)]
    Transaction(#[from] TransactionError),
}

/// Who writes in a world that was taken over.
const AGENT: &str = "cortex";
/// Lists longer than this are data, such as images, and not attributes.
const LONGEST: usize = 16;
/// Largest whole number that a double holds exactly.
const EXACT: f64 = 9_007_199_254_740_992.0;

/// An attribute of the file as values of ours.
fn values(name: &str, content: &Content) -> Result<Vec<(String, NewValue)>, &'static str> {
    let one = |value| Ok(vec![(name.to_owned(), value)]);
    match (content.kind, &content.value) {
        (_, Plain::Nothing(_)) => Err("it has no value"),
        (_, Plain::Bool(truth)) => one(NewValue::Bool(*truth)),
        (1 | 2 | 6 | 7 | 8, value) => match value.number() {
            Some(number) if content.kind != 7 || number < EXACT => one(NewValue::Number(number)),
            _ => match value {
                Plain::Text(text) => one(NewValue::Text(text.as_str().into())),
                _ => Err("it is no number"),
            },
        },
        (_, Plain::Text(text)) => one(NewValue::Text(text.as_str().into())),
        (_, Plain::Number(number)) => one(NewValue::Number(*number)),
        (_, Plain::List(list)) if list.len() > LONGEST => Err("it is a long list"),
        (_, list @ Plain::List(_)) => {
            let numbers = list.numbers().ok_or("it is no list of numbers")?;
            let named = numbers.into_iter().enumerate();
            Ok(named.map(|(at, number)| (format!("{name}_{at}"), NewValue::Number(number))).collect())
        }
    }
}

fn kind(value: &NewValue) -> (Kind, &'static str) {
    match value {
        NewValue::Number(_) | NewValue::Quantity(..) => (Kind::Number, "number"),
        NewValue::Bool(_) => (Kind::Bool, "bool"),
        NewValue::Text(_) | NewValue::Node(_) => (Kind::Text, "text"),
    }
}

/// A token by another name if every dictionary has that already.
fn free(name: &str, is_taken: impl FnOnce(&Dictionary, &str) -> bool) -> String {
    let taken = name.is_empty() || is_taken(&DictionaryBuilder::new().build(), name);
    if taken { format!("cortex_{name}") } else { name.to_owned() }
}

struct Node {
    name: String,
    kind: String,
    values: Vec<(String, NewValue)>,
}

struct Edge {
    from: String,
    label: String,
    to: String,
    values: Vec<(String, NewValue)>,
}

/// Where an attribute is found: on types of nodes, or on edges of a label between types.
#[derive(Default)]
struct Uses {
    nodes: BTreeSet<String>,
    edges: BTreeSet<(String, String, String)>,
}

impl CortexWorld {
    /// The graph of the file.
    pub fn import(&self, unit: CortexUnit) -> Result<Imported, CortexError> {
        let mut notes = Vec::new();
        let (nodes, ids) = self.nodes(&mut notes)?;
        let (edges, poses) = self.links(&nodes, &ids, unit, &mut notes)?;

        let mut builder = DictionaryBuilder::new();
        let touched: BTreeSet<_> = poses.iter().flat_map(|(parent, child, _)| [parent, child]).collect();
        let mut types: BTreeMap<&str, TypeId> = BTreeMap::new();
        for node in &nodes {
            if !types.contains_key(node.kind.as_str()) {
                let geometric =
                    nodes.iter().any(|other| other.kind == node.kind && touched.contains(&other.name));
                let nature = if geometric { Nature::Geometric } else { Nature::Symbolic };
                types.insert(&node.kind, builder.node_type(&node.kind, None, nature)?);
            }
        }
        let kinds: BTreeMap<&str, &str> =
            nodes.iter().map(|node| (node.name.as_str(), node.kind.as_str())).collect();
        let mut labels: BTreeMap<&str, LabelId> = BTreeMap::new();
        for edge in &edges {
            let (from, to) = (types[kinds[edge.from.as_str()]], types[kinds[edge.to.as_str()]]);
            labels.insert(&edge.label, builder.label(&edge.label, from, to)?);
        }
        let attributes = attributes(&mut builder, &nodes, &edges, &kinds, &types, &labels)?;
        builder.agent(AGENT)?;

        let graph = Graph::new(builder.build());
        let mut tx = Transaction::new(AgentId::DSR);
        for node in &nodes {
            tx.add_node(node.name.as_str(), types[node.kind.as_str()]);
        }
        for (parent, child, pose) in &poses {
            tx.set_transform(parent.as_str(), child.as_str(), *pose);
        }
        for edge in &edges {
            tx.add_edge(edge.from.as_str(), labels[edge.label.as_str()], edge.to.as_str());
            for (name, value) in &edge.values {
                let key = (format!("{}.{name}", edge.label), kind(value).1);
                if let Some(&attribute) = attributes.get(&key) {
                    let label = labels[edge.label.as_str()];
                    let holder = HolderRef::edge(edge.from.as_str(), label, edge.to.as_str());
                    tx.set_attribute(holder, attribute, value.clone());
                }
            }
        }
        for node in &nodes {
            for (name, value) in &node.values {
                if let Some(&attribute) = attributes.get(&(name.clone(), kind(value).1)) {
                    tx.set_attribute(node.name.as_str(), attribute, value.clone());
                }
            }
        }
        graph.commit(&tx, Time(0))?;
        Ok(Imported { graph, notes })
    }

    fn nodes(&self, notes: &mut Vec<String>) -> Result<(Vec<Node>, BTreeMap<String, usize>), CortexError> {
        let (mut nodes, mut ids) = (Vec::new(), BTreeMap::new());
        for symbol in self.model.symbols.values() {
            let id = symbol.id.text();
            let kind = free(&symbol.kind, |ours, name| ours.node_type(name).is_some());
            let name = if symbol.name.is_empty() { format!("{kind}_{id}") } else { symbol.name.clone() };
            // Our agents are nodes, too.
            let name = free(&name, |ours, name| name == AGENT || ours.agent(name).is_some());
            let values = gather(&name, &symbol.attribute, notes);
            if ids.insert(id.clone(), nodes.len()).is_some() {
                return Err(CortexError::SameId { id });
            }
            nodes.push(Node { name, kind, values });
        }
        Ok((nodes, ids))
    }

    #[expect(clippy::type_complexity, reason = "edges and poses of one walk")]
    fn links(
        &self,
        nodes: &[Node],
        ids: &BTreeMap<String, usize>,
        unit: CortexUnit,
        notes: &mut Vec<String>,
    ) -> Result<(Vec<Edge>, Vec<(String, String, Isometry3<f64>)>), CortexError> {
        let (mut edges, mut poses) = (Vec::new(), Vec::new());
        for link in self.model.symbols.values().flat_map(|symbol| &symbol.links) {
            let (src, dst) = (link.src.text(), link.dst.text());
            let find = |id: &String| {
                let node = ids.get(id).map(|&at| nodes[at].name.clone());
                node.ok_or_else(|| CortexError::NoSymbol {
                    label: link.label.clone(),
                    src: src.clone(),
                    dst: dst.clone(),
                    missing: id.clone(),
                })
            };
            let (from, to) = (find(&src)?, find(&dst)?);
            if link.label == "RT" {
                let pose = pose(link, unit);
                let pose = pose.ok_or(CortexError::NoPose { parent: from.clone(), child: to.clone() })?;
                poses.push((from, to, pose));
            } else if from == to {
                notes.push(format!(
                    "link `{}` from `{from}` to itself: left out, no edge may do that",
                    link.label
                ));
            } else {
                let label = free(&link.label, |ours, name| ours.label(name).is_some());
                let values = gather(&format!("{from} {label} {to}"), &link.attribute, notes);
                edges.push(Edge { from, label, to, values });
            }
        }
        Ok((edges, poses))
    }
}

fn gather(
    holder: &str,
    contents: &BTreeMap<String, Content>,
    notes: &mut Vec<String>,
) -> Vec<(String, NewValue)> {
    let mut found = Vec::new();
    for (name, content) in contents {
        match values(name, content) {
            Ok(values) => found.extend(values),
            Err(reason) => notes.push(format!("attribute `{name}` of `{holder}`: left out, {reason}")),
        }
    }
    found
}

/// The pose of an RT link: the newest of its ring, if it keeps one.
fn pose(link: &Link, unit: CortexUnit) -> Option<Isometry3<f64>> {
    let numbers = |name: &str| link.attribute.get(name)?.value.numbers();
    let head = link.attribute.get("rt_head_index").and_then(|head| head.value.number());
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped; past the end there is none"
    )]
    let head =
        head.filter(|_| link.attribute.contains_key("rt_timestamps")).map_or(0, |at| at.max(0.0) as usize);
    let three =
        |name: &str| -> Option<[f64; 3]> { numbers(name)?.get(head..head.checked_add(3)?)?.try_into().ok() };
    let [x, y, z] = three("rt_translation")?;
    let [a, b, c] = three("rt_rotation_euler_xyz")?;
    let scale = if unit == CortexUnit::Millimetres { 1e-3 } else { 1.0 };
    let about = |axis, angle| UnitQuaternion::from_axis_angle(&axis, angle);
    let rotation = about(Vector3::x_axis(), a) * about(Vector3::y_axis(), b) * about(Vector3::z_axis(), c);
    Some(Isometry3::from_parts(Translation3::new(x * scale, y * scale, z * scale), rotation))
}

/// Declares what is used; found again by name (with the label before it, on edges) and kind.
fn attributes(
    builder: &mut DictionaryBuilder,
    nodes: &[Node],
    edges: &[Edge],
    kinds: &BTreeMap<&str, &str>,
    types: &BTreeMap<&str, TypeId>,
    labels: &BTreeMap<&str, LabelId>,
) -> Result<BTreeMap<(String, &'static str), AttributeId>, CortexError> {
    let mut uses: BTreeMap<(String, &'static str), (Kind, Uses)> = BTreeMap::new();
    let mut note = |key: String, value: &NewValue| {
        let (kind, word) = kind(value);
        uses.entry((key, word)).or_insert_with(|| (kind, Uses::default()));
        (kind, word)
    };
    let mut found = Vec::new();
    for node in nodes {
        for (name, value) in &node.values {
            let (_, word) = note(name.clone(), value);
            found.push(((name.clone(), word), Ok(node.kind.clone())));
        }
    }
    for edge in edges {
        let ends = (kinds[edge.from.as_str()].to_owned(), kinds[edge.to.as_str()].to_owned());
        for (name, value) in &edge.values {
            let key = format!("{}.{name}", edge.label);
            let (_, word) = note(key.clone(), value);
            found.push(((key, word), Err((edge.label.clone(), ends.0.clone(), ends.1.clone()))));
        }
    }
    for (key, place) in found {
        if let Some((_, uses)) = uses.get_mut(&key) {
            match place {
                Ok(node_type) => uses.nodes.insert(node_type),
                Err(edge) => uses.edges.insert(edge),
            };
        }
    }
    let words: Vec<String> = uses.keys().map(|(name, _)| name.clone()).collect();
    let mut declared = BTreeMap::new();
    for ((name, word), (kind, uses)) in uses {
        // One name with several kinds of values, or the name of what every dictionary has.
        let several = words.iter().filter(|other| **other == name).count() > 1;
        let plain = free(&name, |ours, name| ours.attribute(name).is_some());
        let unique = if several { format!("{plain}.{word}") } else { plain };
        let id = if let Some((label, ..)) = uses.edges.first() {
            let label_id = labels[label.as_str()];
            let ends: BTreeSet<_> =
                uses.edges.iter().map(|(_, from, to)| (from.as_str(), to.as_str())).collect();
            let one = if let [(from, to)] = ends.iter().collect::<Vec<_>>()[..] {
                (types[from], types[to])
            } else {
                // On edges between several types: the label must go between all.
                builder.label(label, TypeId::OBJECT, TypeId::OBJECT)?;
                (TypeId::OBJECT, TypeId::OBJECT)
            };
            builder.attribute_on_edge(&unique, label_id, one, kind)?
        } else {
            let holder = match uses.nodes.first() {
                Some(only) if uses.nodes.len() == 1 => types[only.as_str()],
                _ => TypeId::OBJECT,
            };
            builder.attribute_on_node(&unique, holder, kind)?
        };
        declared.insert((name, word), id);
    }
    Ok(declared)
}

//! A state as plain data: for files, for display, and for comparing states byte by byte.
//!
//! Everything is named, sorted and complete: two states of one vocabulary are equal exactly when their exports are.
//! Reflexes are not included; they belong to running activities and end with the process.

use std::sync::Arc;

use nalgebra::{Isometry3, Quaternion, Translation3, Unit};
use serde::{Deserialize, Serialize};

use crate::id::{AttributeId, EdgeKey, Holder, NodeId, Time, Version};
use crate::lease;
use crate::pose::{Covariance, Pose};
use crate::replay_check::{edge_fits, pose_fits, value_fits};
use crate::snapshot::{AttributeView, Snapshot};
use crate::state::State;
use crate::transaction::{TransactionError, invariants};
use crate::value::Value;
use crate::vocabulary::Vocabulary;

/// A state as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Export {
    /// The version.
    pub version: Version,
    /// The time of its commit.
    pub time: Time,
    /// The id of the next new node.
    pub next: NodeId,
    /// The nodes, by id.
    pub nodes: Vec<ExportedNode>,
    /// The symbolic edges, by ids of start, label and end.
    pub edges: Vec<ExportedEdge>,
    /// The geometric edges, by id of the child.
    pub transforms: Vec<ExportedTransform>,
}

/// A node as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExportedNode {
    /// Its id.
    pub id: NodeId,
    /// Its name.
    pub name: Arc<str>,
    /// Its type.
    #[serde(rename = "type")]
    pub node_type: Arc<str>,
    /// The version that added it.
    pub since: Version,
    /// Its attributes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<ExportedAttribute>,
}

/// An edge as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExportedEdge {
    /// Where it starts.
    pub from: Arc<str>,
    /// Its label.
    pub label: Arc<str>,
    /// Where it ends.
    pub to: Arc<str>,
    /// The version that added it.
    pub since: Version,
    /// Its attributes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub attributes: Vec<ExportedAttribute>,
}

/// An attribute as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExportedAttribute {
    /// Its name.
    pub name: Arc<str>,
    /// Its value.
    pub value: ExportedValue,
    /// The version that wrote it.
    pub since: Version,
}

/// A value as plain data: a node by its name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum ExportedValue {
    Number(f64),
    Text(Arc<str>),
    Bool(bool),
    Node(Arc<str>),
}

/// A geometric edge as plain data: the pose of the child in the frame of the parent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExportedTransform {
    /// The parent.
    pub parent: Arc<str>,
    /// The child.
    pub child: Arc<str>,
    /// x, y, z in metres.
    pub translation: [f64; 3],
    /// The unit quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// The covariance of the pose, if it is known: six rows of x, y, z in metres and the rotation about them in
    /// radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Arc<Covariance>>,
    /// The version that wrote it.
    pub since: Version,
    /// The stamped poses of a moving child, of which the pose above is the newest; empty for a static one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub samples: Vec<ExportedSample>,
}

/// A stamped pose as plain data.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ExportedSample {
    /// The time.
    pub time: Time,
    /// x, y, z in metres.
    pub translation: [f64; 3],
    /// The unit quaternion i, j, k, w.
    pub rotation: [f64; 4],
    /// The covariance of the pose, if it is known: six rows of x, y, z in metres and the rotation about them in
    /// radians.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub covariance: Option<Arc<Covariance>>,
}

impl Snapshot {
    /// The state as plain data.
    pub fn export(&self) -> Export {
        Export {
            version: self.version(),
            time: self.time(),
            next: self.state().next,
            nodes: self.exported_nodes().collect(),
            edges: self.exported_edges().collect(),
            transforms: self.exported_transforms().collect(),
        }
    }

    /// The nodes of the export, one by one.
    pub(crate) fn exported_nodes(&self) -> impl Iterator<Item = ExportedNode> + '_ {
        self.nodes().map(|node| ExportedNode {
            id: node.id,
            name: node.name().into(),
            node_type: self.vocabulary().type_name(node.node_type()).cloned().unwrap_or_default(),
            since: node.since(),
            attributes: node.attributes().map(|view| self.export_attribute(view)).collect(),
        })
    }

    /// The edges of the export, one by one.
    pub(crate) fn exported_edges(&self) -> impl Iterator<Item = ExportedEdge> + '_ {
        self.edges().map(|edge| ExportedEdge {
            from: self.state().name(edge.key.from),
            label: self.vocabulary().label_name(edge.key.label).cloned().unwrap_or_default(),
            to: self.state().name(edge.key.to),
            since: edge.since(),
            attributes: edge.attributes().map(|view| self.export_attribute(view)).collect(),
        })
    }

    /// The transforms of the export, one by one.
    pub(crate) fn exported_transforms(&self) -> impl Iterator<Item = ExportedTransform> + '_ {
        self.nodes().filter_map(|node| {
            let (parent, pose, since) = node.parent()?;
            let (translation, rotation) = numbers_of(pose);
            let samples = node.poses().map(|(time, pose)| {
                let (translation, rotation) = numbers_of(pose);
                ExportedSample { time, translation, rotation, covariance: pose.covariance.clone() }
            });
            Some(ExportedTransform {
                parent: self.state().name(parent),
                child: node.name().into(),
                translation,
                rotation,
                covariance: pose.covariance.clone(),
                since,
                samples: samples.collect(),
            })
        })
    }

    fn export_attribute(&self, view: AttributeView<'_>) -> ExportedAttribute {
        ExportedAttribute {
            name: self.vocabulary().attribute_name(view.attribute).cloned().unwrap_or_default(),
            value: match view.value {
                Value::Number(number) => ExportedValue::Number(*number),
                Value::Text(text) => ExportedValue::Text(text.clone()),
                Value::Bool(truth) => ExportedValue::Bool(*truth),
                Value::Node(node) => ExportedValue::Node(self.state().name(*node)),
            },
            since: view.since,
        }
    }
}

fn numbers_of(pose: &Pose) -> ([f64; 3], [f64; 4]) {
    let (t, q) = (&pose.transform.translation.vector, &pose.transform.rotation.coords);
    ([t.x, t.y, t.z], [q.x, q.y, q.z, q.w])
}

/// The pose of these numbers. It is not normalised, because its bits must stay as they were.
fn pose_of([x, y, z]: [f64; 3], [i, j, k, w]: [f64; 4], covariance: Option<Arc<Covariance>>) -> Pose {
    let rotation = Unit::new_unchecked(Quaternion::new(w, i, j, k));
    Pose { transform: Isometry3::from_parts(Translation3::new(x, y, z), rotation), covariance }
}

/// Why plain data is not a state of the vocabulary.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum RestoreError {
    /// The vocabulary has no such token.
    #[error("the vocabulary has no '{name}'")]
    UnknownToken { name: Arc<str> },
    /// An edge, attribute or transform of a node that does not exist.
    #[error("no node '{name}'")]
    UnknownNode { name: Arc<str> },
    /// Two nodes share an id or a name, or an id is not below `next`.
    #[error("node '{name}' has a name or an id that is not its own")]
    NodeClash { name: Arc<str> },
    /// The node of an agent or a resource of the vocabulary is missing or has another id.
    #[error("'{name}' does not stand for the agent or the resource of that name")]
    NotOfVocabulary { name: Arc<str> },
    /// An edge that the vocabulary does not allow.
    #[error("'{label}' does not go from '{from}' to '{to}'")]
    WrongEdge { from: Arc<str>, label: Arc<str>, to: Arc<str> },
    /// A value of the wrong kind, an attribute of the wrong holder, or a second value.
    #[error("attribute '{attribute}' does not fit")]
    WrongAttribute { attribute: Arc<str> },
    /// A transform that is not rigid, is between nodes that are not geometric, or gives a second parent.
    #[error("no rigid transform from '{parent}' to '{child}'")]
    WrongTransform { parent: Arc<str>, child: Arc<str> },
    /// A resource with two holders, or an agent that waits for a free resource, for two, or in a cycle.
    #[error("leases and waits that no graph would have")]
    WrongLeases,
    /// A version beyond the last possible one.
    #[error("no version {}", found.0)]
    NoVersion { found: Version },
    /// The transforms are not a rooted tree, or a node has too many edges of a label.
    #[error(transparent)]
    Unsound(#[from] TransactionError),
}

/// The last version that the attribute of a lease represents exactly; at one commit per nanosecond it is reached after
/// a hundred days.
const LAST: u64 = 1 << 53;

/// Builds the state of an export, and checks every rule.
pub(crate) fn restore(vocabulary: Arc<Vocabulary>, export: &Export) -> Result<State, RestoreError> {
    if export.version.0 > LAST {
        return Err(RestoreError::NoVersion { found: export.version });
    }
    let mut state = State::empty(vocabulary);
    let mark = state.mark();
    let vocabulary = Arc::clone(&state.vocabulary);
    for node in &export.nodes {
        let id = node.id;
        let clash = id >= export.next || state.node(id).is_some() || state.names.get(&node.name).is_some();
        if clash || node.name.is_empty() {
            return Err(RestoreError::NodeClash { name: node.name.clone() });
        }
        let node_type = vocabulary
            .node_type(&node.node_type)
            .ok_or_else(|| RestoreError::UnknownToken { name: node.node_type.clone() })?;
        state.insert_node(id, node.name.clone(), node_type, node.since);
    }
    check_built_in(&vocabulary, &state)?;
    for edge in &export.edges {
        let key = edge_key(&state, edge)?;
        state.insert_edge(key, edge.since);
        for attribute in &edge.attributes {
            restore_attribute(&mut state, Holder::Edge(key), attribute)?;
        }
    }
    for node in &export.nodes {
        for attribute in &node.attributes {
            restore_attribute(&mut state, Holder::Node(node.id), attribute)?;
        }
    }
    for transform in &export.transforms {
        restore_transform(&mut state, transform)?;
    }
    invariants::check(&mut state, mark)?;
    if !lease::are_sound(&state) {
        return Err(RestoreError::WrongLeases);
    }
    (state.version, state.time, state.next) = (export.version, export.time, export.next);
    state.log.clear();
    Ok(state)
}

fn find(state: &State, name: &Arc<str>) -> Result<NodeId, RestoreError> {
    state.names.get(name).ok_or_else(|| RestoreError::UnknownNode { name: name.clone() })
}

fn check_built_in(vocabulary: &Vocabulary, state: &State) -> Result<(), RestoreError> {
    let agents = vocabulary.agents().map(|id| (vocabulary.agent_name(id), vocabulary.agent_node(id)));
    let resources =
        vocabulary.resources().map(|id| (vocabulary.resource_name(id), vocabulary.resource_node(id)));
    for (name, id) in agents.chain(resources) {
        if let Some(name) = name
            && state.names.get(name) != id
        {
            return Err(RestoreError::NotOfVocabulary { name: name.clone() });
        }
    }
    Ok(())
}

fn edge_key(state: &State, edge: &ExportedEdge) -> Result<EdgeKey, RestoreError> {
    let label = state
        .vocabulary
        .label(&edge.label)
        .ok_or_else(|| RestoreError::UnknownToken { name: edge.label.clone() })?;
    let key = EdgeKey { from: find(state, &edge.from)?, label, to: find(state, &edge.to)? };
    if !edge_fits(state, key) {
        let (from, label, to) = (edge.from.clone(), edge.label.clone(), edge.to.clone());
        return Err(RestoreError::WrongEdge { from, label, to });
    }
    Ok(key)
}

fn restore_attribute(
    state: &mut State,
    holder: Holder,
    exported: &ExportedAttribute,
) -> Result<(), RestoreError> {
    let attribute: AttributeId = state
        .vocabulary
        .attribute(&exported.name)
        .ok_or_else(|| RestoreError::UnknownToken { name: exported.name.clone() })?;
    let value = match &exported.value {
        ExportedValue::Number(number) => Value::Number(*number),
        ExportedValue::Text(text) => Value::Text(text.clone()),
        ExportedValue::Bool(truth) => Value::Bool(*truth),
        ExportedValue::Node(name) => Value::Node(find(state, name)?),
    };
    if !value_fits(state, holder, attribute, &value) || state.cell(holder, attribute).is_some() {
        return Err(RestoreError::WrongAttribute { attribute: exported.name.clone() });
    }
    state.insert_attribute(holder, attribute, value, exported.since);
    Ok(())
}

fn restore_transform(state: &mut State, exported: &ExportedTransform) -> Result<(), RestoreError> {
    let (parent, child) = (find(state, &exported.parent)?, find(state, &exported.child)?);
    let wrong =
        || RestoreError::WrongTransform { parent: exported.parent.clone(), child: exported.child.clone() };
    let pose = |translation, rotation, covariance: &Option<_>| {
        let pose = pose_of(translation, rotation, covariance.clone());
        if pose_fits(state, parent, child, &pose) { Ok(pose) } else { Err(wrong()) }
    };
    if state.joint(child).is_some() {
        return Err(wrong());
    }
    let newest = pose(exported.translation, exported.rotation, &exported.covariance)?;
    let samples =
        exported.samples.iter().map(|s| Ok((s.time, pose(s.translation, s.rotation, &s.covariance)?)));
    let samples = samples.collect::<Result<Vec<_>, RestoreError>>()?;
    if samples.is_empty() {
        state.insert_transform(parent, child, newest, exported.since);
    }
    for (time, pose) in samples {
        state.insert_sample(parent, child, time, pose, exported.since);
    }
    Ok(())
}

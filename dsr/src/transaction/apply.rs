//! Applying a transaction: a pure function from a state to the next one, or to the invariant that it breaks.
//!
//! Idea: edit the state in place, with a log of what was there; whatever does not hold plays the log backwards. Order:
//! the writer's own edits, the tree of transforms, the new reflexes, then the reflexes that the edits broke, each as
//! a small transaction of its owner's with a mark of its own. Invariant: after an error the state is the one before,
//! to the byte. Cost: per edit a few binary searches and one permission look-up; see `BENCHMARKS.md`.

use std::sync::Arc;

use super::error::TransactionError;
use super::{Edit, HolderRef, Transaction, degree, tree};
use crate::block::Node;
use crate::delta::{self, Change, Delta};
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, ReflexId, Time, TypeId, Version};
use crate::pose::Pose;
use crate::state::{Side, State};
use crate::undo::Mark;
use crate::value::{Kind, NewValue, NodeRef, Value};
use crate::vocabulary::{Nature, Token, Vocabulary};

/// What a transaction made of a state.
pub(crate) struct Outcome {
    pub(crate) delta: Delta,
    pub(crate) guards: Vec<ReflexId>,
}

/// Makes the state the next one, or leaves it as it is.
pub(crate) fn transact(
    state: &mut State,
    transaction: &Transaction,
    time: Time,
) -> Result<Outcome, TransactionError> {
    let writer = transaction.writer;
    state.vocabulary.agent_name(writer).ok_or(TransactionError::UnknownAgent { id: writer })?;

    let start = state.begin();
    let done = run(state, transaction, start);
    if done.is_err() {
        state.abandon();
    }
    let (guards, reflexes) = done?;
    let changes = delta::settle(state);
    if !changes.is_empty() || !reflexes.is_empty() {
        (state.version, state.time) = (Version(state.version.0 + 1), time);
    }
    // An id whose node never saw a version was never given out: nothing in the delta would tell a replay of it.
    let added =
        |change: &Change| if let Change::NodeAdded { node, .. } = change { Some(*node) } else { None };
    let last = changes.iter().filter_map(added).max();
    state.next = last.map_or(start.next(), |last| NodeId(last.0 + 1));
    state.log.clear();
    Ok(Outcome {
        delta: Delta { version: state.version, time: state.time, writer, changes, reflexes },
        guards,
    })
}

/// The reflexes registered and those that fired.
fn run(
    state: &mut State,
    transaction: &Transaction,
    start: Mark,
) -> Result<(Vec<ReflexId>, Vec<ReflexId>), TransactionError> {
    let (writer, version) = (transaction.writer, Version(state.version.0 + 1));
    for &reflex in &transaction.dismissed {
        state.dismiss(writer, reflex, version)?;
    }
    for edit in &transaction.edits {
        apply(state, writer, edit, version)?;
    }
    judge(state, start)?;
    state.settle_leases(version);
    let mut guards = Vec::with_capacity(transaction.guards.len());
    for reflex in &transaction.guards {
        guards.push(state.register(writer, reflex, version)?);
    }
    let reflexes = state.fire_broken(version);
    Ok((guards, reflexes))
}

/// Graphs of fewer nodes than this are in the cache anyway.
const LARGE: NodeId = NodeId(1 << 12);

/// Brings what the edits will need into the cache. Checking and writing an edit is a chain of loads that wait for one
/// another, and in a large graph each comes from main memory; asked for at once, they come at once.
pub(crate) fn warm(state: &State, edits: &[Edit]) {
    if state.next < LARGE {
        return;
    }
    let at = |node: &NodeRef, side| match node {
        NodeRef::Id(id) => state.warm(*id, side),
        NodeRef::Name(_) => 0,
    };
    let mut sum = 0;
    for edit in edits {
        sum += match edit {
            Edit::AddEdge { from, to, .. } | Edit::RemoveEdge { from, to, .. } => {
                at(from, Side::Start) + at(to, Side::End)
            }
            Edit::SetAttribute { holder, .. } | Edit::ClearAttribute { holder, .. } => match holder {
                HolderRef::Node(node) => at(node, Side::Holder),
                HolderRef::Edge { from, to, .. } => at(from, Side::Start) + at(to, Side::End),
            },
            _ => 0,
        };
    }
    std::hint::black_box(sum);
}

/// Judges what concerns the graph as a whole, after what was edited since the mark.
pub(crate) fn judge(state: &mut State, mark: Mark) -> Result<(), TransactionError> {
    if state.log.mentions.transforms() {
        state.root = tree::check(state, mark)?;
    }
    degree::check(state, mark)
}

/// Applies one edit, or leaves the state as it is.
pub(crate) fn apply(
    state: &mut State,
    writer: AgentId,
    edit: &Edit,
    since: Version,
) -> Result<(), TransactionError> {
    match edit {
        Edit::AddNode { name, node_type } => add_node(state, writer, name, *node_type, since),
        Edit::RemoveNode { node } => remove_node(state, writer, node),
        Edit::AddEdge { from, label, to } => {
            let key = edge_to_write(state, writer, from, *label, to)?;
            state.insert_edge(key, since);
            Ok(())
        }
        Edit::RemoveEdge { from, label, to } => {
            let key = edge_to_write(state, writer, from, *label, to)?;
            state.remove_edge(key);
            Ok(())
        }
        Edit::SetAttribute { holder, attribute, value } => {
            let holder = attribute_to_write(state, writer, holder, *attribute)?;
            if let Holder::Edge(key) = holder
                && state.edge(key).is_none()
            {
                return Err(TransactionError::MissingEdge {
                    from: state.name(key.from),
                    label: label_name(state, key.label),
                    to: state.name(key.to),
                });
            }
            let value = fitting(state, *attribute, value)?;
            state.insert_attribute(holder, *attribute, value, since);
            Ok(())
        }
        Edit::ClearAttribute { holder, attribute } => {
            let holder = attribute_to_write(state, writer, holder, *attribute)?;
            state.remove_attribute(holder, *attribute);
            Ok(())
        }
        Edit::SetTransform { parent, child, pose } => {
            let (parent, child) = joint_to_write(state, writer, parent, child, pose)?;
            state.insert_transform(parent, child, pose.clone(), since);
            Ok(())
        }
        Edit::SampleTransform { parent, child, time, pose } => {
            let (parent, child) = joint_to_write(state, writer, parent, child, pose)?;
            state.insert_sample(parent, child, *time, pose.clone(), since);
            Ok(())
        }
        Edit::RemoveTransform { parent, child } => {
            let (parent, child) = transform_to_write(state, writer, parent, child)?;
            if state.joint(child).is_some_and(|j| j.parent == parent) {
                state.remove_transform(child);
            }
            Ok(())
        }
        Edit::Claim { resource, priority, preemption } => {
            state.claim(writer, *resource, (*priority, *preemption), since)
        }
        Edit::Await { resource, priority, preemption } => {
            state.claim_or_wait(writer, *resource, (*priority, *preemption), since)
        }
        Edit::Release { resource } => {
            known_resource(state, *resource)?;
            state.give_up(writer, *resource, since);
            Ok(())
        }
        Edit::Expire { agent } => {
            state.vocabulary.agent_name(*agent).ok_or(TransactionError::UnknownAgent { id: *agent })?;
            if writer != AgentId::DSR && writer != *agent {
                let (writer, owner) = (state.agent_name(writer), state.agent_name(*agent));
                return Err(TransactionError::NotOwner { writer, owner });
            }
            state.give_up_all(*agent, since);
            state.reflexes.condemn(*agent);
            Ok(())
        }
    }
}

fn add_node(
    state: &mut State,
    writer: AgentId,
    name: &Arc<str>,
    node_type: TypeId,
    since: Version,
) -> Result<(), TransactionError> {
    state.vocabulary.type_name(node_type).ok_or(TransactionError::UnknownType { id: node_type })?;
    if name.is_empty() {
        return Err(TransactionError::EmptyName);
    }
    if state.names.get(name).is_some() {
        return Err(TransactionError::DuplicateNode { name: name.clone() });
    }
    if node_type == TypeId::AGENT || node_type == TypeId::RESOURCE {
        return Err(TransactionError::Reserved { name: name.clone() });
    }
    permitted(state, writer, Token::Node(node_type), (Named::Name(name), node_type), None)?;
    if state.next >= NodeId::NOWHERE {
        return Err(TransactionError::Full);
    }
    state.insert_node(state.next, name.clone(), node_type, since);
    Ok(())
}

fn remove_node(state: &mut State, writer: AgentId, node: &NodeRef) -> Result<(), TransactionError> {
    let (id, node) = resolve(state, node)?;
    if state.vocabulary.agent_of(id).is_some() || state.vocabulary.resource_of(id).is_some() {
        return Err(TransactionError::Reserved { name: state.name(id) });
    }
    let node_type = node.node_type();
    permitted(state, writer, Token::Node(node_type), (Named::Node(id), node_type), None)?;
    state.remove_node(id);
    Ok(())
}

fn edge_to_write(
    state: &State,
    writer: AgentId,
    from: &NodeRef,
    label: LabelId,
    to: &NodeRef,
) -> Result<EdgeKey, TransactionError> {
    let vocabulary = &state.vocabulary;
    let name = vocabulary.label_name(label).ok_or(TransactionError::UnknownLabel { id: label })?;
    let ((from, start), (to, end)) = (typed(state, from)?, typed(state, to)?);
    if Vocabulary::is_reserved(label) {
        return Err(TransactionError::Reserved { name: name.clone() });
    }
    if from == to {
        return Err(TransactionError::Loop { node: state.name(from), label: name.clone() });
    }
    if !vocabulary.allows(label, start, end) {
        return Err(TransactionError::WrongSignature {
            label: name.clone(),
            from: state.name(from),
            from_type: type_name(state, start),
            to: state.name(to),
            to_type: type_name(state, end),
        });
    }
    let ends = ((Named::Node(from), start), Some((Named::Node(to), end)));
    permitted(state, writer, Token::Label(label), ends.0, ends.1)?;
    Ok(EdgeKey { from, label, to })
}

fn attribute_to_write(
    state: &State,
    writer: AgentId,
    holder: &HolderRef,
    attribute: AttributeId,
) -> Result<Holder, TransactionError> {
    let vocabulary = &state.vocabulary;
    let unknown = TransactionError::UnknownAttribute { id: attribute };
    let (Some(name), Some(declared)) = (vocabulary.attribute_name(attribute), vocabulary.holder(attribute))
    else {
        return Err(unknown);
    };
    let wrong =
        |holder: String| TransactionError::WrongHolder { attribute: name.clone(), holder: holder.into() };
    let token = Token::Attribute(attribute);
    match holder {
        HolderRef::Node(node) => {
            let (id, node_type) = typed(state, node)?;
            if !declared.takes_node(node_type, vocabulary) {
                return Err(wrong(format!("'{}' ({})", state.name(id), type_name(state, node_type))));
            }
            permitted(state, writer, token, (Named::Node(id), node_type), None)?;
            Ok(Holder::Node(id))
        }
        HolderRef::Edge { from, label, to } => {
            let label_name =
                vocabulary.label_name(*label).ok_or(TransactionError::UnknownLabel { id: *label })?;
            let ((from, start), (to, end)) = (typed(state, from)?, typed(state, to)?);
            if Vocabulary::is_reserved(*label) {
                return Err(TransactionError::Reserved { name: label_name.clone() });
            }
            if !declared.takes_edge(*label, (start, end), vocabulary) {
                return Err(wrong(format!("'{}' {label_name} '{}'", state.name(from), state.name(to))));
            }
            let ends = ((Named::Node(from), start), Some((Named::Node(to), end)));
            permitted(state, writer, token, ends.0, ends.1)?;
            Ok(Holder::Edge(EdgeKey { from, label: *label, to }))
        }
    }
}

/// The value as it is stored, if the attribute may hold it.
fn fitting(state: &State, attribute: AttributeId, value: &NewValue) -> Result<Value, TransactionError> {
    let vocabulary = &state.vocabulary;
    let unknown = TransactionError::UnknownAttribute { id: attribute };
    let (Some(name), Some(kind)) = (vocabulary.attribute_name(attribute), vocabulary.kind(attribute)) else {
        return Err(unknown);
    };
    match (kind, value) {
        (Kind::Number, NewValue::Number(number)) if number.is_finite() => Ok(Value::Number(*number)),
        (Kind::Number, NewValue::Quantity(number, unit)) => {
            let expected = vocabulary.unit(attribute);
            let converted = expected.and_then(|wanted| unit.convert(*number, wanted));
            match converted {
                Some(number) if number.is_finite() => Ok(Value::Number(number)),
                Some(_) => Err(TransactionError::NotFinite { token: name.clone() }),
                None => Err(TransactionError::WrongUnit { attribute: name.clone(), expected, found: *unit }),
            }
        }
        (Kind::Number, NewValue::Number(_)) => Err(TransactionError::NotFinite { token: name.clone() }),
        (Kind::Text, NewValue::Text(text)) => Ok(Value::Text(text.clone())),
        (Kind::Bool, NewValue::Bool(truth)) => Ok(Value::Bool(*truth)),
        (Kind::Node(expected), NewValue::Node(node)) => {
            let (id, node_type) = typed(state, node)?;
            if vocabulary.is_a(node_type, expected) {
                return Ok(Value::Node(id));
            }
            Err(TransactionError::WrongTarget {
                attribute: name.clone(),
                expected: type_name(state, expected),
                node: state.name(id),
                node_type: type_name(state, node_type),
            })
        }
        (expected, found) => {
            let found = match found {
                NewValue::Number(_) | NewValue::Quantity(..) => "number",
                NewValue::Text(_) => "text",
                NewValue::Bool(_) => "bool",
                NewValue::Node(_) => "node",
            };
            Err(TransactionError::WrongKind { attribute: name.clone(), expected, found })
        }
    }
}

/// The ends of a geometric edge that may get this pose.
fn joint_to_write(
    state: &State,
    writer: AgentId,
    parent: &NodeRef,
    child: &NodeRef,
    pose: &Pose,
) -> Result<(NodeId, NodeId), TransactionError> {
    let (parent, child) = transform_to_write(state, writer, parent, child)?;
    if !pose.is_finite() {
        return Err(TransactionError::NotFinite { token: "a transform".into() });
    }
    if !pose.is_rigid() {
        return Err(TransactionError::NotRigid { parent: state.name(parent), child: state.name(child) });
    }
    if parent == child {
        return Err(TransactionError::Cycle { parent: state.name(parent), child: state.name(child) });
    }
    match state.joint(child) {
        Some(joint) if joint.parent != parent => Err(TransactionError::SecondParent {
            child: state.name(child),
            parent: state.name(joint.parent),
            refused: state.name(parent),
        }),
        _ => Ok((parent, child)),
    }
}

fn transform_to_write(
    state: &State,
    writer: AgentId,
    parent: &NodeRef,
    child: &NodeRef,
) -> Result<(NodeId, NodeId), TransactionError> {
    let ((parent, above), (child, below)) = (typed(state, parent)?, typed(state, child)?);
    for (node, node_type) in [(parent, above), (child, below)] {
        if state.vocabulary.nature(node_type) != Some(Nature::Geometric) {
            let (node, node_type) = (state.name(node), type_name(state, node_type));
            return Err(TransactionError::NotGeometric { node, node_type });
        }
    }
    let ends = ((Named::Node(parent), above), Some((Named::Node(child), below)));
    permitted(state, writer, Token::Transform, ends.0, ends.1)?;
    Ok((parent, child))
}

/// A name to be looked up only if a permission or an error asks for it.
#[derive(Clone, Copy)]
enum Named<'a> {
    Name(&'a str),
    Node(NodeId),
}

impl<'a> Named<'a> {
    fn name(self, state: &'a State) -> &'a str {
        match self {
            Self::Name(name) => name,
            Self::Node(id) => state.names.of(id).map_or("", |name| name),
        }
    }
}

fn permitted(
    state: &State,
    writer: AgentId,
    token: Token,
    from: (Named<'_>, TypeId),
    to: Option<(Named<'_>, TypeId)>,
) -> Result<(), TransactionError> {
    let from_name = || from.0.name(state);
    let to_name = || to.map_or("", |(name, _)| name.name(state));
    if state.vocabulary.permits(writer, token, (&from_name, from.1), to.map(|to| (&to_name as _, to.1))) {
        return Ok(());
    }
    let token = match token {
        Token::Label(id) => format!("label '{}'", label_name(state, id)),
        Token::Attribute(id) => {
            let name = state.vocabulary.attribute_name(id);
            format!("attribute '{}'", name.map_or("?", |name| name))
        }
        Token::Transform => "transforms".to_owned(),
        Token::Node(id) => format!("nodes of type '{}'", type_name(state, id)),
    };
    Err(TransactionError::Forbidden {
        writer: state.agent_name(writer),
        token: token.into(),
        from: from.0.name(state).into(),
        to: to.map(|(name, _)| name.name(state).into()),
    })
}

fn typed(state: &State, node: &NodeRef) -> Result<(NodeId, TypeId), TransactionError> {
    resolve(state, node).map(|(id, node)| (id, node.node_type()))
}

fn resolve<'a>(state: &'a State, node: &NodeRef) -> Result<(NodeId, Node<'a>), TransactionError> {
    let id = match node {
        NodeRef::Id(id) => Some(*id),
        NodeRef::Name(name) => state.names.get(name),
    };
    id.and_then(|id| Some((id, state.node(id)?)))
        .ok_or_else(|| TransactionError::UnknownNode { node: node.clone() })
}

pub(super) fn known_resource(state: &State, id: crate::id::ResourceId) -> Result<(), TransactionError> {
    state.vocabulary.resource_name(id).map(|_| ()).ok_or(TransactionError::UnknownResource { id })
}

fn type_name(state: &State, id: TypeId) -> Arc<str> {
    state.vocabulary.type_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

fn label_name(state: &State, id: LabelId) -> Arc<str> {
    state.vocabulary.label_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

pub(crate) fn resource_name(state: &State, id: crate::id::ResourceId) -> Arc<str> {
    state.vocabulary.resource_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

//! Applying a transaction: a pure function from a state to the next one, or to the invariant that it breaks.
//!
//! Idea: edit a copy (a handful of reference counts), publish it only if everything holds. That a failed
//! transaction leaves the graph untouched needs no undo and no proof. Order: the writer's own edits, the tree of
//! transforms, the new reflexes, then the reflexes that the edits broke, each as a small transaction of its
//! owner's. Cost: per edit a few binary searches and one permission look-up; see `BENCHMARKS.md`.

use std::sync::Arc;

use super::error::TransactionError;
use super::{Edit, HolderRef, Preemption, Transaction, tree};
use crate::delta::{self, Change, Delta};
use crate::dictionary::{HolderType, Nature, Token};
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, ReflexId, Time, TypeId, Version};
use crate::state::{Node, State};
use crate::value::{Kind, NewValue, NodeRef, Value};

/// What a transaction makes of a state.
pub(crate) struct Outcome {
    pub(crate) state: State,
    pub(crate) delta: Delta,
    pub(crate) guards: Vec<ReflexId>,
}

pub(crate) fn transact(
    before: &State,
    transaction: &Transaction,
    time: Time,
) -> Result<Outcome, TransactionError> {
    if let Some(expected) = transaction.expected
        && expected != before.version
    {
        return Err(TransactionError::Stale { expected, current: before.version });
    }
    let writer = transaction.writer;
    before.dictionary.agent_name(writer).ok_or(TransactionError::UnknownAgent { id: writer })?;

    let mut state = before.clone();
    let version = Version(before.version.0 + 1);
    for &reflex in &transaction.dismissed {
        state.dismiss(writer, reflex)?;
    }
    for edit in &transaction.edits {
        apply(&mut state, writer, edit, version)?;
    }
    judge(before, &mut state)?;
    let mut guards = Vec::with_capacity(transaction.guards.len());
    for reflex in &transaction.guards {
        guards.push(state.register(writer, reflex, version)?);
    }
    let reflexes = state.fire_broken(version);

    let changes = delta::settle(before, &mut state);
    state.scratch = crate::state::Scratch::default();
    let (version, time) = if changes.is_empty() && reflexes.is_empty() {
        (before.version, before.time)
    } else {
        (version, time)
    };
    (state.version, state.time) = (version, time);
    // An id whose node never saw a version was never given out: nothing in the delta would tell a replay of it.
    let added =
        |change: &Change| if let Change::NodeAdded { node, .. } = change { Some(*node) } else { None };
    let last = changes.iter().filter_map(added).max();
    state.next = last.map_or(before.next, |last| NodeId(last.0 + 1));
    Ok(Outcome { state, delta: Delta { version, time, writer, changes, reflexes }, guards })
}

/// Judges what concerns the graph as a whole.
pub(crate) fn judge(before: &State, state: &mut State) -> Result<(), TransactionError> {
    if state.scratch.mentions.transforms() {
        state.root = tree::check(before, state, &state.scratch.touched)?;
    }
    Ok(())
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
        Edit::SetTransform { parent, child, transform } => {
            let (parent, child) = transform_to_write(state, writer, parent, child)?;
            let numbers = transform.translation.vector.iter().chain(transform.rotation.coords.iter());
            if !numbers.copied().all(f64::is_finite) {
                return Err(TransactionError::NotFinite { token: "a transform".into() });
            }
            if parent == child {
                return Err(TransactionError::Cycle { parent: state.name(parent), child: state.name(child) });
            }
            if let Some(joint) = state.node(child).and_then(|node| node.joint.as_ref())
                && joint.parent != parent
            {
                return Err(TransactionError::SecondParent {
                    child: state.name(child),
                    parent: state.name(joint.parent),
                    refused: state.name(parent),
                });
            }
            state.insert_transform(parent, child, *transform, since);
            Ok(())
        }
        Edit::RemoveTransform { parent, child } => {
            let (parent, child) = transform_to_write(state, writer, parent, child)?;
            if state.node(child).and_then(|node| node.joint.as_ref()).is_some_and(|j| j.parent == parent) {
                state.remove_transform(child);
            }
            Ok(())
        }
        Edit::Claim { resource, priority, preemption } => {
            known_resource(state, *resource)?;
            if let Some(lease) = state.lease(*resource) {
                let taken = *priority > lease.priority
                    && lease.preemption == Preemption::Yields
                    // Two claims of one transaction would be one grant: neither could be told from the other.
                    && lease.claimed != since;
                if !taken {
                    return Err(TransactionError::ResourceHeld {
                        resource: resource_name(state, *resource),
                        holder: state.agent_name(lease.holder),
                        priority: lease.priority,
                        preemption: lease.preemption,
                    });
                }
                state.revoke(lease.holder, *resource);
            }
            state.grant(writer, *resource, *priority, *preemption, since);
            Ok(())
        }
        Edit::Release { resource } => {
            known_resource(state, *resource)?;
            state.revoke(writer, *resource);
            Ok(())
        }
        Edit::Expire { agent } => {
            state.dictionary.agent_name(*agent).ok_or(TransactionError::UnknownAgent { id: *agent })?;
            if writer != AgentId::DSR && writer != *agent {
                let (writer, owner) = (state.agent_name(writer), state.agent_name(*agent));
                return Err(TransactionError::NotOwner { writer, owner });
            }
            for resource in state.leases_of(*agent) {
                state.revoke(*agent, resource);
            }
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
    state.dictionary.type_name(node_type).ok_or(TransactionError::UnknownType { id: node_type })?;
    if name.is_empty() {
        return Err(TransactionError::EmptyName);
    }
    if state.names.get(name).is_some() {
        return Err(TransactionError::DuplicateNode { name: name.clone() });
    }
    if node_type == TypeId::AGENT || node_type == TypeId::RESOURCE {
        return Err(TransactionError::Reserved { name: name.clone() });
    }
    permitted(state, writer, Token::Node(node_type), (name, node_type), None)?;
    if state.next >= NodeId::NOWHERE {
        return Err(TransactionError::Full);
    }
    state.insert_node(state.next, name.clone(), node_type, since);
    Ok(())
}

fn remove_node(state: &mut State, writer: AgentId, node: &NodeRef) -> Result<(), TransactionError> {
    let (id, node) = resolve(state, node)?;
    if state.dictionary.agent_of(id).is_some() || state.dictionary.resource_of(id).is_some() {
        return Err(TransactionError::Reserved { name: node.name.clone() });
    }
    permitted(state, writer, Token::Node(node.node_type), (&node.name, node.node_type), None)?;
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
    let dictionary = &state.dictionary;
    let name = dictionary.label_name(label).ok_or(TransactionError::UnknownLabel { id: label })?;
    let ((from, start), (to, end)) = (resolve(state, from)?, resolve(state, to)?);
    if label == LabelId::HOLDS {
        return Err(TransactionError::Reserved { name: name.clone() });
    }
    if from == to {
        return Err(TransactionError::Loop { node: start.name.clone(), label: name.clone() });
    }
    if !dictionary.allows(label, start.node_type, end.node_type) {
        return Err(TransactionError::WrongSignature {
            label: name.clone(),
            from: start.name.clone(),
            from_type: type_name(state, start.node_type),
            to: end.name.clone(),
            to_type: type_name(state, end.node_type),
        });
    }
    permitted(
        state,
        writer,
        Token::Label(label),
        (&start.name, start.node_type),
        Some((&end.name, end.node_type)),
    )?;
    Ok(EdgeKey { from, label, to })
}

fn attribute_to_write(
    state: &State,
    writer: AgentId,
    holder: &HolderRef,
    attribute: AttributeId,
) -> Result<Holder, TransactionError> {
    let dictionary = &state.dictionary;
    let unknown = TransactionError::UnknownAttribute { id: attribute };
    let (Some(name), Some(declared)) = (dictionary.attribute_name(attribute), dictionary.holder(attribute))
    else {
        return Err(unknown);
    };
    let wrong =
        |holder: String| TransactionError::WrongHolder { attribute: name.clone(), holder: holder.into() };
    let token = Token::Attribute(attribute);
    match holder {
        HolderRef::Node(node) => {
            let (id, node) = resolve(state, node)?;
            if !matches!(declared, HolderType::Node(holder) if dictionary.is_a(node.node_type, holder)) {
                return Err(wrong(format!("'{}' ({})", node.name, type_name(state, node.node_type))));
            }
            permitted(state, writer, token, (&node.name, node.node_type), None)?;
            Ok(Holder::Node(id))
        }
        HolderRef::Edge { from, label, to } => {
            let label_name =
                dictionary.label_name(*label).ok_or(TransactionError::UnknownLabel { id: *label })?;
            let ((from, start), (to, end)) = (resolve(state, from)?, resolve(state, to)?);
            if *label == LabelId::HOLDS {
                return Err(TransactionError::Reserved { name: label_name.clone() });
            }
            let fits = matches!(declared, HolderType::Edge { label: on, signature }
                if on == *label
                    && dictionary.is_a(start.node_type, signature.from)
                    && dictionary.is_a(end.node_type, signature.to));
            if !fits {
                return Err(wrong(format!("'{}' {label_name} '{}'", start.name, end.name)));
            }
            let ends = ((&*start.name, start.node_type), Some((&*end.name, end.node_type)));
            permitted(state, writer, token, ends.0, ends.1)?;
            Ok(Holder::Edge(EdgeKey { from, label: *label, to }))
        }
    }
}

/// The value as it is stored, if the attribute may hold it.
fn fitting(state: &State, attribute: AttributeId, value: &NewValue) -> Result<Value, TransactionError> {
    let dictionary = &state.dictionary;
    let unknown = TransactionError::UnknownAttribute { id: attribute };
    let (Some(name), Some(kind)) = (dictionary.attribute_name(attribute), dictionary.kind(attribute)) else {
        return Err(unknown);
    };
    match (kind, value) {
        (Kind::Number, NewValue::Number(number)) if number.is_finite() => Ok(Value::Number(*number)),
        (Kind::Number, NewValue::Number(_)) => Err(TransactionError::NotFinite { token: name.clone() }),
        (Kind::Text, NewValue::Text(text)) => Ok(Value::Text(text.clone())),
        (Kind::Bool, NewValue::Bool(truth)) => Ok(Value::Bool(*truth)),
        (Kind::Node(expected), NewValue::Node(node)) => {
            let (id, node) = resolve(state, node)?;
            if dictionary.is_a(node.node_type, expected) {
                return Ok(Value::Node(id));
            }
            Err(TransactionError::WrongTarget {
                attribute: name.clone(),
                expected: type_name(state, expected),
                node: node.name.clone(),
                node_type: type_name(state, node.node_type),
            })
        }
        (expected, found) => {
            let found = match found {
                NewValue::Number(_) => "number",
                NewValue::Text(_) => "text",
                NewValue::Bool(_) => "bool",
                NewValue::Node(_) => "node",
            };
            Err(TransactionError::WrongKind { attribute: name.clone(), expected, found })
        }
    }
}

fn transform_to_write(
    state: &State,
    writer: AgentId,
    parent: &NodeRef,
    child: &NodeRef,
) -> Result<(NodeId, NodeId), TransactionError> {
    let ((parent, above), (child, below)) = (resolve(state, parent)?, resolve(state, child)?);
    for node in [above, below] {
        if state.dictionary.nature(node.node_type) != Some(Nature::Geometric) {
            return Err(TransactionError::NotGeometric {
                node: node.name.clone(),
                node_type: type_name(state, node.node_type),
            });
        }
    }
    let ends = ((&*above.name, above.node_type), Some((&*below.name, below.node_type)));
    permitted(state, writer, Token::Transform, ends.0, ends.1)?;
    Ok((parent, child))
}

fn permitted(
    state: &State,
    writer: AgentId,
    token: Token,
    from: (&str, TypeId),
    to: Option<(&str, TypeId)>,
) -> Result<(), TransactionError> {
    if state.dictionary.may_write(writer, token, from, to) {
        return Ok(());
    }
    let token = match token {
        Token::Label(id) => format!("label '{}'", label_name(state, id)),
        Token::Attribute(id) => {
            let name = state.dictionary.attribute_name(id);
            format!("attribute '{}'", name.map_or("?", |name| name))
        }
        Token::Transform => "transforms".to_owned(),
        Token::Node(id) => format!("nodes of type '{}'", type_name(state, id)),
    };
    Err(TransactionError::Forbidden {
        writer: state.agent_name(writer),
        token: token.into(),
        from: from.0.into(),
        to: to.map(|(name, _)| name.into()),
    })
}

fn resolve<'a>(state: &'a State, node: &NodeRef) -> Result<(NodeId, &'a Node), TransactionError> {
    let id = match node {
        NodeRef::Id(id) => Some(*id),
        NodeRef::Name(name) => state.names.get(name),
    };
    id.and_then(|id| Some((id, state.node(id)?)))
        .ok_or_else(|| TransactionError::UnknownNode { node: node.clone() })
}

fn known_resource(state: &State, id: crate::id::ResourceId) -> Result<(), TransactionError> {
    state.dictionary.resource_name(id).map(|_| ()).ok_or(TransactionError::UnknownResource { id })
}

fn type_name(state: &State, id: TypeId) -> Arc<str> {
    state.dictionary.type_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

fn label_name(state: &State, id: LabelId) -> Arc<str> {
    state.dictionary.label_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

fn resource_name(state: &State, id: crate::id::ResourceId) -> Arc<str> {
    state.dictionary.resource_name(id).cloned().unwrap_or_else(|| id.to_string().into())
}

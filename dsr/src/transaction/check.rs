//! First stage of an edit: the rules for this edit alone.
//!
//! Each function resolves what the edit names, checks it against the vocabulary, the state and the writer's
//! permissions, and returns the ids to write. It changes nothing. Rules for the graph as a whole are in `invariants`.

use std::sync::Arc;

use super::edit::HolderRef;
use super::error::TransactionError;
use super::names::{label_name, type_name};
use crate::block::Node;
use crate::id::{AgentId, AttributeId, EdgeKey, Holder, LabelId, NodeId, TypeId};
use crate::pose::Pose;
use crate::state::State;
use crate::value::{Kind, NewValue, NodeRef, Value};
use crate::vocabulary::{Nature, Token, Vocabulary};

/// Checks that the writer may add a node of this name and type.
pub(super) fn new_node(
    state: &State,
    writer: AgentId,
    name: &Arc<str>,
    node_type: TypeId,
) -> Result<NodeId, TransactionError> {
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
    if state.next >= NodeId::NOWHERE { Err(TransactionError::Full) } else { Ok(state.next) }
}

/// Checks that the writer may remove the node.
pub(super) fn old_node(state: &State, writer: AgentId, node: &NodeRef) -> Result<NodeId, TransactionError> {
    let (id, node) = resolve(state, node)?;
    if state.vocabulary.agent_of(id).is_some() || state.vocabulary.resource_of(id).is_some() {
        return Err(TransactionError::Reserved { name: state.name(id) });
    }
    let node_type = node.node_type();
    permitted(state, writer, Token::Node(node_type), (Named::Node(id), node_type), None)?;
    Ok(id)
}

/// Checks that the writer may add or remove the edge.
pub(super) fn edge(
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

/// Checks that the writer may set or clear the attribute of this holder.
pub(super) fn holder(
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

/// Checks that an edge exists whose attribute is to be set.
pub(super) fn exists(state: &State, holder: Holder) -> Result<(), TransactionError> {
    match holder {
        Holder::Edge(key) if state.edge(key).is_none() => Err(TransactionError::MissingEdge {
            from: state.name(key.from),
            label: label_name(state, key.label),
            to: state.name(key.to),
        }),
        Holder::Edge(_) | Holder::Node(_) => Ok(()),
    }
}

/// Checks that the writer may declare the agent dead.
pub(super) fn expiry(state: &State, writer: AgentId, agent: AgentId) -> Result<(), TransactionError> {
    state.vocabulary.agent_name(agent).ok_or(TransactionError::UnknownAgent { id: agent })?;
    if writer == AgentId::DSR || writer == agent {
        return Ok(());
    }
    Err(TransactionError::NotOwner { writer: state.agent_name(writer), owner: state.agent_name(agent) })
}

/// The value as the attribute stores it: in its unit, and with the id of a node.
pub(super) fn value(
    state: &State,
    attribute: AttributeId,
    value: &NewValue,
) -> Result<Value, TransactionError> {
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

/// Checks that the writer may set the pose of `child` in `parent`.
pub(super) fn pose(
    state: &State,
    writer: AgentId,
    parent: &NodeRef,
    child: &NodeRef,
    pose: &Pose,
) -> Result<(NodeId, NodeId), TransactionError> {
    let (parent, child) = transform(state, writer, parent, child)?;
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

/// Checks that the writer may set or remove the transform between these nodes.
pub(super) fn transform(
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

/// A name that is looked up only if a permission or an error needs it.
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

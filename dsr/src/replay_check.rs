//! What may stand in a state, whoever says that it did: a restored export, a replayed delta.
//!
//! A transaction is checked edit by edit, and told what is wrong with it. What was read from a file is held against the
//! same rules here, part by part, and only whether it fits is told, because a graph never wrote what does not.
//! What concerns the graph as a whole is judged when all parts are there: the tree of transforms by
//! `transaction::tree`, leases and waits by `transaction::lease`.

use crate::block::Node;
use crate::id::{AttributeId, EdgeKey, Holder, NodeId, TypeId};
use crate::pose::Pose;
use crate::state::State;
use crate::value::{Kind, Value};
use crate::vocabulary::Nature;

fn type_of(state: &State, id: NodeId) -> Option<TypeId> {
    state.node(id).map(Node::node_type)
}

/// Whether an edge may come. Leases and waits are edges like others here.
pub(crate) fn edge_fits(state: &State, key: EdgeKey) -> bool {
    let EdgeKey { from, label, to } = key;
    let types = type_of(state, from).zip(type_of(state, to));
    let allowed = types.is_some_and(|(start, end)| state.vocabulary.allows(label, start, end));
    from != to && allowed && state.edge(key).is_none()
}

/// Whether an attribute may have this value there.
pub(crate) fn value_fits(state: &State, holder: Holder, attribute: AttributeId, value: &Value) -> bool {
    let vocabulary = &state.vocabulary;
    let sits = vocabulary.holder(attribute).is_some_and(|declared| match holder {
        Holder::Node(node) => {
            type_of(state, node).is_some_and(|found| declared.takes_node(found, vocabulary))
        }
        Holder::Edge(key) => {
            let ends = type_of(state, key.from).zip(type_of(state, key.to));
            state.edge(key).is_some()
                && ends.is_some_and(|ends| declared.takes_edge(key.label, ends, vocabulary))
        }
    });
    sits && match (vocabulary.kind(attribute), value) {
        (Some(Kind::Number), Value::Number(number)) => number.is_finite(),
        (Some(Kind::Text), Value::Text(_)) | (Some(Kind::Bool), Value::Bool(_)) => true,
        (Some(Kind::Node(target)), Value::Node(node)) => {
            type_of(state, *node).is_some_and(|found| vocabulary.is_a(found, target))
        }
        _ => false,
    }
}

/// Whether a pose may be given between these two, if no other parent is in the way.
pub(crate) fn pose_fits(state: &State, parent: NodeId, child: NodeId, pose: &Pose) -> bool {
    let geometric = |id| {
        let nature = type_of(state, id).and_then(|found| state.vocabulary.nature(found));
        nature == Some(Nature::Geometric)
    };
    parent != child && geometric(parent) && geometric(child) && pose.is_rigid()
}

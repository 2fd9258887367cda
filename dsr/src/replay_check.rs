//! Rules for parts of a state that come from outside: a restored export, a replayed delta.
//!
//! A transaction is checked edit by edit, with an error that explains the fault (`transaction::check`). Data from a
//! file is checked here against the same rules, part by part, with a yes or no: a graph never writes data that breaks
//! them. Rules for the graph as a whole are checked when all parts are in place: transforms and degrees by
//! `transaction::invariants`, leases and waits by `lease::are_sound`.

use crate::block::Node;
use crate::id::{AttributeId, EdgeKey, Holder, NodeId, TypeId};
use crate::pose::Pose;
use crate::state::State;
use crate::value::{Kind, Value};
use crate::vocabulary::Nature;

fn type_of(state: &State, id: NodeId) -> Option<TypeId> {
    state.node(id).map(Node::node_type)
}

/// Whether an edge may be added. Leases and waits count as edges here.
pub(crate) fn edge_fits(state: &State, key: EdgeKey) -> bool {
    let EdgeKey { from, label, to } = key;
    let types = type_of(state, from).zip(type_of(state, to));
    let allowed = types.is_some_and(|(start, end)| state.vocabulary.allows(label, start, end));
    from != to && allowed && state.edge(key).is_none()
}

/// Whether the attribute of this holder may have this value.
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

/// Whether `child` may have this pose in `parent`, as far as it has no other parent.
pub(crate) fn pose_fits(state: &State, parent: NodeId, child: NodeId, pose: &Pose) -> bool {
    let geometric = |id| {
        let nature = type_of(state, id).and_then(|found| state.vocabulary.nature(found));
        nature == Some(Nature::Geometric)
    };
    parent != child && geometric(parent) && geometric(child) && pose.is_rigid()
}

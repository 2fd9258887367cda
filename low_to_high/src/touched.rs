//! From the changed tokens of a delta to the heads that must be derived again.
//!
//! Invariant: a head that agrees with none of an axiom's [`Affected`] partial heads keeps its truth value.

use dsr::{Delta, Holder, NodeId, TypeId};
use pddl::model::{Name, PredicateId};
use rustc_hash::FxHashMap;

use crate::axiom::{Axiom, Dependency, Place, Token};
use crate::relations::{Partial, Tuple};

/// With more partial heads than this, deriving all heads once is cheaper.
const MANY: usize = 64;

/// The heads of an axiom that a change can affect.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Affected {
    Nothing,
    /// The heads that agree with one of these.
    Some(Vec<Partial>),
    All,
}

/// The changes so far: tokens of the graph, and derived facts.
#[derive(Debug, Default)]
pub(crate) struct Touched {
    tokens: FxHashMap<Token, Vec<Tuple>>,
    nodes: Vec<(NodeId, TypeId)>,
}

impl Touched {
    pub(crate) fn of(delta: &Delta) -> Self {
        let mut touched = Self::default();
        for change in &delta.changes {
            match change {
                dsr::Change::NodeAdded { node, node_type, .. }
                | dsr::Change::NodeRemoved { node, node_type, .. } => touched.nodes.push((*node, *node_type)),
                dsr::Change::EdgeAdded { edge } | dsr::Change::EdgeRemoved { edge } => {
                    touched.push(Token::Label(edge.label), vec![edge.from, edge.to]);
                }
                dsr::Change::AttributeAdded { holder, attribute, .. }
                | dsr::Change::AttributeChanged { holder, attribute, .. }
                | dsr::Change::AttributeRemoved { holder, attribute, .. } => {
                    let tuple = match holder {
                        Holder::Node(node) => vec![*node],
                        Holder::Edge(edge) => vec![edge.from, edge.to],
                    };
                    touched.push(Token::Attribute(*attribute), tuple);
                }
                dsr::Change::TransformAdded { .. }
                | dsr::Change::TransformChanged { .. }
                | dsr::Change::TransformSampled { .. }
                | dsr::Change::TransformRemoved { .. } => touched.push(Token::Transforms, Vec::new()),
            }
        }
        touched
    }

    /// Records that a derived fact appeared or disappeared.
    pub(crate) fn derived(&mut self, predicate: PredicateId, tuple: Tuple) {
        self.push(Token::Predicate(predicate), tuple);
    }

    fn push(&mut self, token: Token, tuple: Tuple) {
        self.tokens.entry(token).or_default().push(tuple);
    }

    /// The heads of an axiom that the changes can affect. `name_of` also knows the nodes that were just removed.
    pub(crate) fn affected(
        &self,
        axiom: &Axiom,
        name_of: &dyn Fn(NodeId) -> Option<Name>,
        is_a: &dyn Fn(TypeId, TypeId) -> bool,
    ) -> Affected {
        // A new or removed node changes the range of every quantifier; that is rare, so derive everything again.
        let ranges = |&(node, of): &(NodeId, TypeId)| {
            axiom.types.iter().any(|&id| is_a(of, id))
                || name_of(node).is_some_and(|name| axiom.constants.contains(&name))
        };
        if self.nodes.iter().any(ranges) {
            return Affected::All;
        }
        let mut partials: Vec<Partial> = Vec::new();
        for dependency in &axiom.dependencies {
            for tuple in self.tokens.get(&dependency.token).into_iter().flatten() {
                let Some(partial) = instance(dependency, tuple, axiom.arity(), name_of) else { continue };
                if partial.iter().all(Option::is_none) {
                    return Affected::All;
                }
                if !partials.contains(&partial) {
                    partials.push(partial);
                }
                if partials.len() > MANY {
                    return Affected::All;
                }
            }
        }
        if partials.is_empty() { Affected::Nothing } else { Affected::Some(partials) }
    }
}

/// The heads for which the tuple is an instance of the literal; `None` if there are no such heads.
fn instance(
    dependency: &Dependency,
    tuple: &[NodeId],
    arity: usize,
    name_of: &dyn Fn(NodeId) -> Option<Name>,
) -> Option<Partial> {
    let mut partial = vec![None; arity];
    for (place, &node) in dependency.places.iter().zip(tuple) {
        match place {
            Place::Any => {}
            Place::Named(name) if name_of(node).as_ref() == Some(name) => {}
            Place::Named(_) => return None,
            Place::Head(at) => {
                if partial[*at].is_some_and(|other| other != node) {
                    return None;
                }
                partial[*at] = Some(node);
            }
        }
    }
    Some(partial)
}

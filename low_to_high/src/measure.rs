//! The numbers of the planner that are sensed: derived functions of `perception.pddl`, compiled.
//!
//! Idea: a count is a relation of its own, whose head has the parameters and the counted variables; its facts are
//! derived and updated like any other's, and the number is how many of them begin with the parameters. An attribute is
//! read where it is. Invariant: after every update the numbers are those of a derivation from scratch. Cost: a delta
//! that changes a counted fact counts the facts of that one fluent again.

use dsr::{AttributeId, Delta, EdgeKey, Kind, NodeId, Snapshot, TypeId, Value};
use pddl::model::{
    self, DerivedFunction, DerivedValue, Domain, ExpressionKind, Idx, Name, PredicateId, Variables,
};
use vocabulary::{Holder, Located, Scope, Term, Tokens};

use crate::perception_error::{PerceptionError, PerceptionErrorKind};
use crate::relations::{Relations, Tuple};

/// A derived function.
#[derive(Debug)]
pub(crate) struct Measure {
    pub(crate) name: Name,
    /// The number of its parameters.
    pub(crate) arity: usize,
    pub(crate) value: Measured,
}

#[derive(Debug)]
pub(crate) enum Measured {
    /// How many facts of this relation begin with the parameters.
    Count(PredicateId),
    /// The attribute of a node or an edge, and the types of the parameters.
    Attribute { holder: Holder, attribute: AttributeId, types: Vec<Vec<TypeId>> },
}

/// The counted condition as the body of an axiom: parameters first, then the counted variables.
pub(crate) fn counted(function: &DerivedFunction) -> Option<(Variables, &model::Condition)> {
    let DerivedValue::Count(bound, condition) = &function.value else { return None };
    let mut variables = function.variables.clone();
    debug_assert!(bound.iter().enumerate().all(|(i, slot)| slot.index() == variables.parameters + i));
    variables.parameters += bound.len();
    Some((variables, condition))
}

/// The attribute that a derived function reads.
pub(crate) fn read(
    domain: &Domain,
    tokens: &Tokens,
    function: &DerivedFunction,
) -> Result<Measured, Vec<PerceptionError>> {
    let link = tokens.link(domain);
    let located = |errors: Vec<vocabulary::LinkError>| -> Vec<PerceptionError> {
        errors.into_iter().map(|error| Located::new(error.span, error.kind.into())).collect()
    };
    let one = |span, kind| vec![Located::new(span, kind)];
    let DerivedValue::Expression(expression) = &function.value else {
        return Err(one(function.span, PerceptionErrorKind::NotMeasured));
    };
    let ExpressionKind::Fluent(application) = &expression.kind else {
        return Err(one(expression.span, PerceptionErrorKind::NotMeasured));
    };
    let scope = link.scope(&function.variables).map_err(located)?;
    let (holder, attribute) = link.attribute(&scope, application).map_err(located)?;
    if tokens.vocabulary().kind(attribute) != Some(Kind::Number) {
        return Err(one(expression.span, PerceptionErrorKind::NotMeasured));
    }
    let named: Vec<usize> = holder.terms().into_iter().filter_map(place).collect();
    if let Some(missing) = (0..function.variables.parameters).find(|slot| !named.contains(slot)) {
        let variable = function.variables.parameters()[missing].name.clone();
        return Err(one(expression.span, PerceptionErrorKind::NotNamed { variable }));
    }
    let types = scope.parameters().map(|slot| scope_types(&scope, slot)).collect();
    Ok(Measured::Attribute { holder, attribute, types })
}

fn scope_types(scope: &Scope, slot: model::VariableId) -> Vec<TypeId> {
    scope.slot(slot).types.clone()
}

fn place(term: &Term) -> Option<usize> {
    match term {
        Term::Variable(variable) => Some(variable.index()),
        Term::Named(_) => None,
    }
}

impl Measure {
    /// The value of a fluent that nothing in the graph gives: no facts are 0, no attribute is no number.
    pub(crate) fn default(&self) -> Option<f64> {
        match self.value {
            Measured::Count(_) => Some(0.0),
            Measured::Attribute { .. } => None,
        }
    }

    /// The value of a fluent.
    pub(crate) fn value(&self, tuple: &[NodeId], snapshot: &Snapshot, relations: &Relations) -> Option<f64> {
        match &self.value {
            Measured::Count(predicate) => Some(relations.beginning_with(*predicate, tuple)),
            Measured::Attribute { holder, attribute, types } => {
                let vocabulary = snapshot.vocabulary();
                let fits = tuple.iter().zip(types).all(|(&node, types)| {
                    let of = snapshot.get(node).map(|view| view.node_type());
                    of.is_some_and(|of| types.iter().any(|&id| vocabulary.is_a(of, id)))
                });
                let node = |term: &Term| match term {
                    Term::Named(name) => snapshot.node(name),
                    Term::Variable(variable) => tuple.get(variable.index()).copied(),
                };
                let holder = match holder {
                    Holder::Node(on) => dsr::Holder::Node(node(on)?),
                    Holder::Edge { from, label, to } => {
                        dsr::Holder::Edge(EdgeKey { from: node(from)?, label: *label, to: node(to)? })
                    }
                };
                fits.then(|| snapshot.attribute(holder, *attribute).and_then(Value::as_number))?
            }
        }
    }

    /// The fluents whose attribute a holder has, or would have.
    fn about(&self, nodes: &[NodeId], name_of: &dyn Fn(NodeId) -> Option<Name>) -> Option<Tuple> {
        let Measured::Attribute { holder, .. } = &self.value else { return None };
        let mut tuple: Vec<Option<NodeId>> = vec![None; self.arity];
        for (term, &node) in holder.terms().into_iter().zip(nodes) {
            match term {
                Term::Named(name) => name_of(node).filter(|other| other == name).map(|_| ())?,
                Term::Variable(variable) => {
                    let slot = &mut tuple[variable.index()];
                    if slot.is_some_and(|other| other != node) {
                        return None;
                    }
                    *slot = Some(node);
                }
            }
        }
        tuple.into_iter().collect()
    }

    /// Every fluent that has an attribute in the graph.
    pub(crate) fn all(&self, snapshot: &Snapshot) -> Vec<Tuple> {
        let Measured::Attribute { holder, .. } = &self.value else { return Vec::new() };
        let name_of = |id: NodeId| snapshot.name(id).map(Name::new);
        let holders: Vec<Vec<NodeId>> = match holder {
            Holder::Node(_) => snapshot.nodes().map(|node| vec![node.id]).collect(),
            Holder::Edge { label, .. } => {
                let edges = snapshot.edges().filter(|edge| edge.key.label == *label);
                edges.map(|edge| vec![edge.key.from, edge.key.to]).collect()
            }
        };
        holders.iter().filter_map(|nodes| self.about(nodes, &name_of)).collect()
    }

    /// The fluents whose attribute a delta may have changed.
    pub(crate) fn touched(&self, delta: &Delta, name_of: &dyn Fn(NodeId) -> Option<Name>) -> Vec<Tuple> {
        let Measured::Attribute { holder, attribute, .. } = &self.value else { return Vec::new() };
        let holders = delta.changes.iter().filter_map(|change| match (holder, change) {
            (
                _,
                dsr::Change::AttributeAdded { holder: on, attribute: of, .. }
                | dsr::Change::AttributeChanged { holder: on, attribute: of, .. }
                | dsr::Change::AttributeRemoved { holder: on, attribute: of, .. },
            ) if of == attribute => match (holder, on) {
                (Holder::Node(_), dsr::Holder::Node(node)) => Some(vec![*node]),
                (Holder::Edge { label, .. }, dsr::Holder::Edge(edge)) if edge.label == *label => {
                    Some(vec![edge.from, edge.to])
                }
                _ => None,
            },
            (
                Holder::Node(_),
                dsr::Change::NodeAdded { node, .. } | dsr::Change::NodeRemoved { node, .. },
            ) => Some(vec![*node]),
            (
                Holder::Edge { label, .. },
                dsr::Change::EdgeAdded { edge } | dsr::Change::EdgeRemoved { edge },
            ) if edge.label == *label => Some(vec![edge.from, edge.to]),
            _ => None,
        });
        let mut tuples: Vec<Tuple> = holders.filter_map(|nodes| self.about(&nodes, name_of)).collect();
        tuples.sort_unstable();
        tuples.dedup();
        tuples
    }
}

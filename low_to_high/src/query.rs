//! Matching the body of an axiom: depth first, always the cheapest part next.
//!
//! Idea: a literal whose variables are all bound is a filter. An equality, a reference or an edge with one bound end
//! binds its other variables. A derived predicate is read from the facts derived so far. Only if no literal can bind
//! more, a variable takes each node of its type in turn. A negated part is evaluated as soon as its outer variables are
//! bound. Cost: the product of the fan-outs along the way.

use std::ops::ControlFlow;

use dsr::{Comparison, EdgeKey, NodeId, Snapshot, TypeId, Value};
use pddl::model::{Idx, VariableId};
use vocabulary::{Conjunction, Holder, Literal, Right, Scope, Term};

use crate::relations::Relations;

/// The variables of an axiom while it is matched.
#[derive(Debug, Clone)]
pub(crate) struct Environment {
    nodes: Vec<Option<NodeId>>,
    types: Vec<Vec<TypeId>>,
}

impl Environment {
    /// An environment in which all variables are free.
    pub(crate) fn new(scope: &Scope) -> Self {
        let slots = scope.slots();
        let types = slots.iter().map(|slot| slot.types.clone()).collect();
        Self { nodes: vec![None; slots.len()], types }
    }

    /// The node that a variable is bound to.
    pub(crate) fn node(&self, variable: VariableId) -> Option<NodeId> {
        self.nodes[variable.index()]
    }

    /// Binds a parameter.
    pub(crate) fn bind(&mut self, at: usize, node: NodeId) {
        self.nodes[at] = Some(node);
    }
}

/// A graph and the facts derived from it.
#[derive(Clone, Copy)]
pub(crate) struct Query<'a> {
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) relations: &'a Relations,
}

pub(crate) type Emit<'e> = &'e mut dyn FnMut(&Environment) -> ControlFlow<()>;

/// The parts of a conjunction that are not matched yet, as bits: literals first, then negated parts.
#[derive(Clone, Copy)]
struct Rest(u128);

impl Rest {
    fn of(part: &Conjunction) -> Self {
        let count = part.literals.len() + part.without.len();
        Self(if count == 0 { 0 } else { u128::MAX >> (128 - count) })
    }

    fn contains(self, at: usize) -> bool {
        self.0 >> at & 1 == 1
    }

    fn without(self, at: usize) -> Self {
        Self(self.0 & !(1 << at))
    }
}

impl Query<'_> {
    /// Emits every completion of the environment that matches the conjunction and binds the variables `wanted`.
    pub(crate) fn solve(
        &self,
        part: &Conjunction,
        wanted: &[VariableId],
        environment: &mut Environment,
        emit: Emit<'_>,
    ) -> ControlFlow<()> {
        for &(variable, id) in &part.variables {
            environment.types[variable.index()] = vec![id];
            environment.nodes[variable.index()] = None;
        }
        // A variable that the caller bound must have a node of its type.
        for &variable in wanted {
            if environment.node(variable).is_some_and(|node| !self.admits(environment, variable, node)) {
                return ControlFlow::Continue(());
            }
        }
        self.step(part, wanted, Rest::of(part), environment, emit)
    }

    /// Whether the conjunction has a match.
    pub(crate) fn matches(&self, part: &Conjunction, environment: &Environment) -> bool {
        let mut environment = environment.clone();
        self.solve(part, &[], &mut environment, &mut |_| ControlFlow::Break(())).is_break()
    }

    fn step(
        &self,
        part: &Conjunction,
        wanted: &[VariableId],
        mut rest: Rest,
        environment: &mut Environment,
        emit: Emit<'_>,
    ) -> ControlFlow<()> {
        let bound = |variable: VariableId| environment.node(variable).is_some();
        for (at, (literal, _)) in part.literals.iter().enumerate() {
            if rest.contains(at) && literal.variables().all(bound) {
                if !self.holds(literal, environment) {
                    return ControlFlow::Continue(());
                }
                rest = rest.without(at);
            }
        }
        for (at, without) in part.without.iter().enumerate() {
            let at = part.literals.len() + at;
            if rest.contains(at) && without.free().into_iter().all(bound) {
                if self.matches(without, environment) {
                    return ControlFlow::Continue(());
                }
                rest = rest.without(at);
            }
        }
        let open = part.literals.iter().enumerate().filter(|(at, _)| rest.contains(*at));
        let next = open.filter_map(|(at, (literal, _))| Some((cost(literal, environment)?, at))).min();
        if let Some((_, at)) = next {
            return self.walk(part, at, wanted, rest.without(at), environment, emit);
        }
        let inner = part.variables.iter().map(|(variable, _)| *variable);
        let Some(variable) = inner.chain(wanted.iter().copied()).find(|&variable| !bound(variable)) else {
            return emit(environment);
        };
        for id in environment.types[variable.index()].clone() {
            for node in self.snapshot.nodes_of(id) {
                environment.nodes[variable.index()] = Some(node);
                self.step(part, wanted, rest, environment, emit)?;
                environment.nodes[variable.index()] = None;
            }
        }
        ControlFlow::Continue(())
    }

    /// Binds the free variables of a literal in every way that makes it hold.
    fn walk(
        &self,
        part: &Conjunction,
        at: usize,
        wanted: &[VariableId],
        rest: Rest,
        environment: &mut Environment,
        emit: Emit<'_>,
    ) -> ControlFlow<()> {
        let literal = &part.literals[at].0;
        let terms: Vec<&Term> = literal.terms();
        for nodes in self.instances(literal, environment) {
            let before = environment.nodes.clone();
            let fits = terms.iter().zip(&nodes).all(|(term, &node)| match term {
                Term::Named(_) => true,
                Term::Variable(variable) => match environment.node(*variable) {
                    Some(bound) => bound == node,
                    None => {
                        let admitted = self.admits(environment, *variable, node);
                        environment.nodes[variable.index()] = Some(node);
                        admitted
                    }
                },
            });
            if fits {
                self.step(part, wanted, rest, environment, emit)?;
            }
            environment.nodes = before;
        }
        ControlFlow::Continue(())
    }

    /// The nodes of a literal's terms, for each instance that holds.
    fn instances(&self, literal: &Literal, environment: &Environment) -> Vec<Vec<NodeId>> {
        let node = |term: &Term| self.node(term, environment);
        match literal {
            Literal::Edge { from, label, to } => match (node(from), node(to)) {
                (Some(start), None) if is_variable(to) => {
                    let Some(view) = self.snapshot.get(start) else { return Vec::new() };
                    let ends = view.edges().filter(|edge| edge.key.label == *label);
                    ends.map(|edge| vec![start, edge.key.to]).collect()
                }
                (None, Some(end)) if is_variable(from) => {
                    let Some(view) = self.snapshot.get(end) else { return Vec::new() };
                    let starts = view.incoming().filter(|key| key.label == *label);
                    starts.map(|key| vec![key.from, end]).collect()
                }
                (None, None) if is_variable(from) && is_variable(to) => {
                    let edges = self.snapshot.edges().filter(|edge| edge.key.label == *label);
                    edges.map(|edge| vec![edge.key.from, edge.key.to]).collect()
                }
                _ => Vec::new(),
            },
            Literal::Same(a, b) => {
                node(a).or_else(|| node(b)).map(|node| vec![node, node]).into_iter().collect()
            }
            Literal::Compare { holder, attribute, right: Right::Term(_), .. } => {
                let Some(holder) = self.holder(holder, environment) else { return Vec::new() };
                let Some(target) = self.snapshot.attribute(holder, *attribute).and_then(Value::as_node)
                else {
                    return Vec::new();
                };
                vec![match holder {
                    dsr::Holder::Node(on) => vec![on, target],
                    dsr::Holder::Edge(EdgeKey { from, to, .. }) => vec![from, to, target],
                }]
            }
            Literal::Derived { predicate, arguments, .. } => {
                let fixed: Vec<_> = arguments.iter().map(node).collect();
                let missing =
                    arguments.iter().zip(&fixed).any(|(term, node)| !is_variable(term) && node.is_none());
                if missing {
                    return Vec::new();
                }
                self.relations.matching(*predicate, &fixed).cloned().collect()
            }
            _ => Vec::new(),
        }
    }

    /// Whether a literal holds. All its variables must be bound.
    pub(crate) fn holds(&self, literal: &Literal, environment: &Environment) -> bool {
        let node = |term: &Term| self.node(term, environment);
        match literal {
            Literal::Edge { from, label, to } => match (node(from), node(to)) {
                (Some(from), Some(to)) => self.snapshot.has_edge(from, *label, to),
                _ => false,
            },
            Literal::Present { holder, attribute } => self
                .holder(holder, environment)
                .is_some_and(|holder| self.snapshot.attribute(holder, *attribute).is_some()),
            Literal::Compare { holder, attribute, comparison, right } => {
                let value = |holder: &Holder, attribute| {
                    self.snapshot.attribute(self.holder(holder, environment)?, attribute).cloned()
                };
                let right = match right {
                    Right::Value(value) => Some(value.clone()),
                    Right::Term(term) => node(term).map(Value::Node),
                    Right::Attribute(holder, attribute) => value(holder, *attribute),
                };
                match (value(holder, *attribute), right) {
                    (Some(left), Some(right)) => compare(*comparison, &left, &right),
                    _ => false,
                }
            }
            Literal::Same(a, b) => node(a).is_some() && node(a) == node(b),
            Literal::Differ(a, b) => match (node(a), node(b)) {
                (Some(a), Some(b)) => a != b,
                _ => false,
            },
            Literal::Distance { from, to, comparison, metres } => match (node(from), node(to)) {
                (Some(from), Some(to)) => self
                    .snapshot
                    .distance(from, to)
                    .is_ok_and(|found| compare(*comparison, &Value::Number(found), &Value::Number(*metres))),
                _ => false,
            },
            Literal::Derived { predicate, arguments, .. } => {
                let tuple: Option<Vec<_>> = arguments.iter().map(node).collect();
                tuple.is_some_and(|tuple| self.relations.contains(*predicate, &tuple))
            }
        }
    }

    fn node(&self, term: &Term, environment: &Environment) -> Option<NodeId> {
        match term {
            Term::Named(name) => self.snapshot.node(name),
            Term::Variable(variable) => environment.node(*variable),
        }
    }

    fn holder(&self, holder: &Holder, environment: &Environment) -> Option<dsr::Holder> {
        Some(match holder {
            Holder::Node(on) => dsr::Holder::Node(self.node(on, environment)?),
            Holder::Edge { from, label, to } => dsr::Holder::Edge(EdgeKey {
                from: self.node(from, environment)?,
                label: *label,
                to: self.node(to, environment)?,
            }),
        })
    }

    fn admits(&self, environment: &Environment, variable: VariableId, node: NodeId) -> bool {
        let Some(view) = self.snapshot.get(node) else { return false };
        let vocabulary = self.snapshot.vocabulary();
        environment.types[variable.index()].iter().any(|&id| vocabulary.is_a(view.node_type(), id))
    }
}

/// The cost of binding the free variables of a literal; `None` if the literal cannot bind them.
fn cost(literal: &Literal, environment: &Environment) -> Option<u8> {
    let bound = |term: &Term| match term {
        Term::Named(_) => true,
        Term::Variable(variable) => environment.node(*variable).is_some(),
    };
    match literal {
        Literal::Same(a, b) if bound(a) || bound(b) => Some(0),
        Literal::Compare { holder, comparison: Comparison::Equal, right: Right::Term(_), .. }
            if holder.terms().into_iter().all(bound) =>
        {
            Some(1)
        }
        Literal::Edge { from, to, .. } => Some(if bound(from) || bound(to) { 2 } else { 5 }),
        Literal::Derived { arguments, .. } => Some(if arguments.iter().any(bound) { 3 } else { 4 }),
        _ => None,
    }
}

fn is_variable(term: &Term) -> bool {
    matches!(term, Term::Variable(_))
}

/// Compares two values as the graph does.
fn compare(comparison: Comparison, left: &Value, right: &Value) -> bool {
    match comparison {
        Comparison::Equal => left == right,
        Comparison::NotEqual => left != right,
        order => match (left.as_number(), right.as_number()) {
            (Some(left), Some(right)) => match order {
                Comparison::Less => left < right,
                Comparison::LessOrEqual => left <= right,
                Comparison::Greater => left > right,
                _ => left >= right,
            },
            _ => false,
        },
    }
}

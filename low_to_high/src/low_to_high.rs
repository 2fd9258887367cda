//! The facts perceived in one graph, kept up to date.
//!
//! Idea: update component by component, in the order of derivation. An axiom is evaluated again only for the heads that
//! the delta, or a changed fact of an earlier component, can affect (`touched`); the result replaces the axiom's earlier
//! result for those heads. A recursive component is derived from scratch when any of its axioms is affected. Invariant:
//! after every update the facts are those that [`LowToHigh::new`] would derive from the same snapshot.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;
use std::sync::Arc;

use dsr::{Delta, NodeId, Snapshot};
use pddl::model::{Name, PredicateId, VariableId};
use rustc_hash::FxHashMap;

use crate::axiom::Axiom;
use crate::fact::{Change, Fact, Fluent};
use crate::measure::{Measure, Measured};
use crate::perception::{Perception, Role};
use crate::query::{Environment, Query};
use crate::relations::{Partial, Relations, Tuple};
use crate::strata::Component;
use crate::touched::{Affected, Touched};

/// The facts that a perception derives from a graph.
#[derive(Debug, Clone)]
pub struct LowToHigh {
    pub(crate) perception: Arc<Perception>,
    pub(crate) relations: Relations,
    /// The names of the nodes in the last snapshot, because facts have names as arguments.
    names: FxHashMap<NodeId, Name>,
    facts: BTreeSet<Fact>,
    /// The sensed numbers that have a value other than that of a fluent of which the graph says nothing.
    numbers: BTreeMap<Fluent, f64>,
}

/// Whether each tuple held before its component was derived again.
type Before = BTreeMap<(PredicateId, Tuple), bool>;

impl LowToHigh {
    /// Derives everything from a snapshot.
    pub fn new(perception: Arc<Perception>, snapshot: &Snapshot) -> Self {
        let relations = Relations::new(perception.axioms.len(), perception.predicates.len());
        let names = snapshot.nodes().map(|node| (node.id, Name::new(node.name()))).collect();
        let mut new = Self { perception, relations, names, facts: BTreeSet::new(), numbers: BTreeMap::new() };
        let perception = Arc::clone(&new.perception);
        let mut before = Before::new();
        for component in &perception.components {
            new.derive_component(component, snapshot, &mut before);
        }
        new.publish(&before);
        for (at, measure) in perception.measures.iter().enumerate() {
            let tuples = measure.all(snapshot).into_iter().chain(new.counted(measure, &before));
            for tuple in tuples.collect::<BTreeSet<_>>() {
                new.measure(at, &tuple, snapshot);
            }
        }
        new
    }

    /// Applies a delta. `snapshot` is the graph right after it; the deltas must come without gaps.
    pub fn update(&mut self, snapshot: &Snapshot, delta: &Delta) -> Change {
        for change in &delta.changes {
            if let dsr::Change::NodeAdded { node, name, .. } = change {
                self.names.insert(*node, Name::new(name));
            }
        }
        let perception = Arc::clone(&self.perception);
        let mut touched = Touched::of(delta);
        let mut all = Before::new();
        for component in &perception.components {
            let mut before = Before::new();
            self.update_component(component, snapshot, &touched, &mut before);
            for ((predicate, tuple), held) in before {
                if self.relations.contains(predicate, &tuple) != held {
                    touched.derived(predicate, tuple.clone());
                    all.insert((predicate, tuple), held);
                }
            }
        }
        let mut change = self.publish(&all);
        for (at, measure) in perception.measures.iter().enumerate() {
            let touched = measure.touched(delta, &|id| self.names.get(&id).cloned());
            let tuples: BTreeSet<Tuple> = touched.into_iter().chain(self.counted(measure, &all)).collect();
            change.numbers.extend(tuples.iter().filter_map(|tuple| self.measure(at, tuple, snapshot)));
        }
        change.numbers.sort_by(|(a, _), (b, _)| a.cmp(b));
        for change in &delta.changes {
            if let dsr::Change::NodeRemoved { node, .. } = change {
                self.names.remove(node);
            }
        }
        change
    }

    /// The planner's facts that hold, sorted.
    pub fn facts(&self) -> impl Iterator<Item = &Fact> {
        self.facts.iter()
    }

    /// The sensed numbers, sorted; a fluent that is not listed has the value of [`Perception::numbers`].
    pub fn numbers(&self) -> impl Iterator<Item = (&Fluent, f64)> {
        self.numbers.iter().map(|(fluent, value)| (fluent, *value))
    }

    /// The fluents of a count of which a counted fact changed.
    fn counted(&self, measure: &Measure, changed: &Before) -> Vec<Tuple> {
        let Measured::Count(predicate) = measure.value else { return Vec::new() };
        let own = changed.keys().filter(|(id, _)| *id == predicate);
        own.map(|(_, tuple)| tuple[..measure.arity].to_vec()).collect()
    }

    /// Takes the value of a fluent anew; it with its value if that changed.
    fn measure(&mut self, at: usize, tuple: &Tuple, snapshot: &Snapshot) -> Option<(Fluent, Option<f64>)> {
        let perception = Arc::clone(&self.perception);
        let measure = &perception.measures[at];
        let fluent = Fluent { function: measure.name.clone(), arguments: self.names_of(tuple) };
        let (value, default) = (measure.value(tuple, snapshot, &self.relations), measure.default());
        let before = match value.filter(|_| value != default) {
            Some(value) => self.numbers.insert(fluent.clone(), value),
            None => self.numbers.remove(&fluent),
        };
        (before.or(default) != value).then_some((fluent, value))
    }

    /// Whether one of the planner's facts holds.
    pub fn perceives(&self, fact: &Fact) -> bool {
        self.facts.contains(fact)
    }

    /// All derived facts, auxiliary ones included, sorted by declaration and arguments.
    pub fn derived(&self) -> impl Iterator<Item = Fact> + '_ {
        let predicates = self.perception.predicates.enumerate();
        predicates.flat_map(move |(id, _)| self.relations.tuples(id).map(move |tuple| self.fact(id, tuple)))
    }

    fn fact(&self, predicate: PredicateId, tuple: &[NodeId]) -> Fact {
        let predicate = self.perception.predicates[predicate].name.clone();
        Fact { predicate, arguments: self.names_of(tuple) }
    }

    fn names_of(&self, tuple: &[NodeId]) -> Vec<Name> {
        let name = |id: &NodeId| self.names.get(id).cloned().unwrap_or_else(|| Name::new(&id.to_string()));
        tuple.iter().map(name).collect()
    }

    /// Updates the planner's facts from the tuples that may have changed.
    fn publish(&mut self, before: &Before) -> Change {
        let mut change = Change::default();
        for ((predicate, tuple), held) in before {
            let holds = self.relations.contains(*predicate, tuple);
            if holds == *held || self.perception.predicates[*predicate].role != Role::HighLevel {
                continue;
            }
            let fact = self.fact(*predicate, tuple);
            if holds {
                self.facts.insert(fact.clone());
                change.appeared.push(fact);
            } else {
                self.facts.remove(&fact);
                change.disappeared.push(fact);
            }
        }
        change.appeared.sort_unstable();
        change.disappeared.sort_unstable();
        change
    }

    fn update_component(
        &mut self,
        component: &Component,
        snapshot: &Snapshot,
        touched: &Touched,
        before: &mut Before,
    ) {
        let perception = Arc::clone(&self.perception);
        let vocabulary = &perception.vocabulary;
        for &at in &component.axioms {
            let axiom = &perception.axioms[at];
            let names = &self.names;
            let affected =
                touched.affected(axiom, &|id| names.get(&id).cloned(), &|a, b| vocabulary.is_a(a, b));
            match affected {
                Affected::Nothing => {}
                _ if component.recursive => return self.derive_component(component, snapshot, before),
                Affected::All => self.derive(at, snapshot, &vec![None; axiom.arity()], before),
                Affected::Some(partials) => {
                    partials.iter().for_each(|partial| self.derive(at, snapshot, partial, before));
                }
            }
        }
    }

    /// Derives a component from scratch.
    fn derive_component(&mut self, component: &Component, snapshot: &Snapshot, before: &mut Before) {
        let perception = Arc::clone(&self.perception);
        let open = |at: usize| vec![None; perception.axioms[at].arity()];
        if !component.recursive {
            component.axioms.iter().for_each(|&at| self.derive(at, snapshot, &open(at), before));
            return;
        }
        for &predicate in &component.predicates {
            let held: Vec<Tuple> = self.relations.tuples(predicate).cloned().collect();
            before.extend(held.into_iter().map(|tuple| ((predicate, tuple), true)));
        }
        for &at in &component.axioms {
            let predicate = perception.axioms[at].predicate;
            for tuple in self.relations.heads(at, &open(at)) {
                self.relations.remove(at, predicate, &tuple);
            }
        }
        // There is no negation inside the component, so each round only adds, up to the least fixpoint.
        let mut grown = true;
        while grown {
            grown = false;
            for &at in &component.axioms {
                let axiom = &perception.axioms[at];
                for tuple in self.heads(axiom, snapshot, &open(at)) {
                    if self.relations.insert(at, axiom.predicate, &tuple) {
                        before.entry((axiom.predicate, tuple)).or_insert(false);
                        grown = true;
                    }
                }
            }
        }
    }

    /// Evaluates an axiom again for the heads that agree with a partial head.
    fn derive(&mut self, at: usize, snapshot: &Snapshot, partial: &Partial, before: &mut Before) {
        let perception = Arc::clone(&self.perception);
        let axiom = &perception.axioms[at];
        let new = self.heads(axiom, snapshot, partial);
        for tuple in self.relations.heads(at, partial) {
            if !new.contains(&tuple) {
                self.note(axiom.predicate, &tuple, before);
                self.relations.remove(at, axiom.predicate, &tuple);
            }
        }
        for tuple in new {
            if !self.relations.gives(at, &tuple) {
                self.note(axiom.predicate, &tuple, before);
                self.relations.insert(at, axiom.predicate, &tuple);
            }
        }
    }

    /// Records whether a tuple held before its component changed.
    fn note(&self, predicate: PredicateId, tuple: &Tuple, before: &mut Before) {
        let held = self.relations.contains(predicate, tuple);
        before.entry((predicate, tuple.clone())).or_insert(held);
    }

    fn heads(&self, axiom: &Axiom, snapshot: &Snapshot, partial: &Partial) -> BTreeSet<Tuple> {
        let query = Query { snapshot, relations: &self.relations };
        let parameters: Vec<VariableId> = axiom.scope.parameters().collect();
        let ground = partial.iter().all(Option::is_some);
        let mut found = BTreeSet::new();
        for part in &axiom.body {
            let mut environment = Environment::new(&axiom.scope);
            for (at, node) in partial.iter().enumerate() {
                if let Some(node) = node {
                    environment.bind(at, *node);
                }
            }
            let _ = query.solve(part, &parameters, &mut environment, &mut |environment| {
                let head: Option<Tuple> = parameters.iter().map(|&v| environment.node(v)).collect();
                found.extend(head);
                if ground { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            if ground && !found.is_empty() {
                break;
            }
        }
        found
    }
}

//! Why a fact is perceived, or what is missing for it, down to the tokens.
//!
//! Idea: a fact that holds is explained by the first match of the first alternative that gives it, with each derived
//! literal replaced by its own reasons. A fact that does not hold is explained by the alternative that lacks the fewest
//! tokens: the literals that fail in the order of the source, and for a negated part the tokens that match it. A
//! predicate that depends on itself is explained once.

use std::ops::ControlFlow;

use dsr::{NodeId, Snapshot};
use pddl::model::{PredicateId, VariableId};
use serde::Serialize;
use vocabulary::{Conjunction, Formula, Literal, Sentence, Speaker, Term};

use crate::axiom::Axiom;
use crate::fact::Fact;
use crate::low_to_high::LowToHigh;
use crate::query::{Environment, Query};

/// The most bindings that are followed while looking for the missing tokens.
const FRONTIER: usize = 64;

/// Why a fact holds or does not.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Explanation {
    /// It holds; the tokens that support it.
    Holds(Vec<Sentence>),
    /// It does not hold; the state of the graph that prevents it.
    Absent(Vec<Sentence>),
    /// No axiom derives it, or an argument is not a node.
    NotPerceived,
}

impl LowToHigh {
    /// Why a fact holds or does not; it may be auxiliary. `snapshot` is the one of the last update.
    pub fn why(&self, snapshot: &Snapshot, fact: &Fact) -> Explanation {
        let tuple: Option<Vec<NodeId>> = fact.arguments.iter().map(|name| snapshot.node(name)).collect();
        let (Some(predicate), Some(tuple)) = (self.perception.find(&fact.predicate), tuple) else {
            return Explanation::NotPerceived;
        };
        let query = Query { snapshot, relations: &self.relations };
        let mut explaining = Explaining { seen: self, query, path: Vec::new() };
        if self.relations.contains(predicate, &tuple) {
            Explanation::Holds(explaining.holds(predicate, &tuple))
        } else {
            Explanation::Absent(explaining.absent(predicate, &tuple))
        }
    }

    /// The sentences of [`LowToHigh::why`]: the tokens that support the fact, or those that are missing.
    pub fn explain(&self, snapshot: &Snapshot, fact: &Fact) -> Vec<String> {
        match self.why(snapshot, fact) {
            Explanation::Holds(said) | Explanation::Absent(said) => {
                said.iter().map(ToString::to_string).collect()
            }
            Explanation::NotPerceived => Vec::new(),
        }
    }
}

struct Explaining<'a> {
    seen: &'a LowToHigh,
    query: Query<'a>,
    /// The facts that are being explained, outermost first.
    path: Vec<(PredicateId, Vec<NodeId>)>,
}

impl<'a> Explaining<'a> {
    fn axioms(&self, predicate: PredicateId) -> impl Iterator<Item = &'a Axiom> + use<'a> {
        let perception = &self.seen.perception;
        perception.predicates[predicate].axioms.iter().map(|&at| &perception.axioms[at])
    }

    fn holds(&mut self, predicate: PredicateId, tuple: &[NodeId]) -> Vec<Sentence> {
        let key = (predicate, tuple.to_vec());
        if self.path.contains(&key) {
            return Vec::new();
        }
        self.path.push(key);
        let mut said = Vec::new();
        for axiom in self.axioms(predicate) {
            let witness = axiom.body.iter().find_map(|part| Some((part, self.witness(axiom, part, tuple)?)));
            if let Some((part, environment)) = witness {
                said = self.affirmed(axiom, part, &environment);
                break;
            }
        }
        self.path.pop();
        said
    }

    /// The first match of an alternative for a head.
    fn witness(&self, axiom: &Axiom, part: &Conjunction, tuple: &[NodeId]) -> Option<Environment> {
        let parameters: Vec<VariableId> = axiom.scope.parameters().collect();
        self.first(part, &parameters, self.head(axiom, tuple))
    }

    fn head(&self, axiom: &Axiom, tuple: &[NodeId]) -> Environment {
        let mut environment = Environment::new(&axiom.scope);
        tuple.iter().enumerate().for_each(|(at, &node)| environment.bind(at, node));
        environment
    }

    fn first(&self, part: &Conjunction, wanted: &[VariableId], mut from: Environment) -> Option<Environment> {
        let mut found = None;
        let _ = self.query.solve(part, wanted, &mut from, &mut |environment| {
            found = Some(environment.clone());
            ControlFlow::Break(())
        });
        found
    }

    /// A whole match in words.
    fn affirmed(&mut self, axiom: &Axiom, part: &Conjunction, environment: &Environment) -> Vec<Sentence> {
        let mut said = Vec::new();
        for (literal, _) in &part.literals {
            add(&mut said, self.affirmed_literal(axiom, literal, environment));
        }
        for without in &part.without {
            add(&mut said, self.denied_part(axiom, without, environment));
        }
        said
    }

    fn affirmed_literal(
        &mut self,
        axiom: &Axiom,
        literal: &Literal,
        environment: &Environment,
    ) -> Vec<Sentence> {
        match self.ground(literal, environment) {
            Some((predicate, tuple)) => self.holds(predicate, &tuple),
            None if matches!(literal, Literal::Same(..) | Literal::Differ(..)) => Vec::new(),
            None => vec![self.speak(axiom, environment, |speaker| speaker.affirm(literal))],
        }
    }

    fn denied_literal(
        &mut self,
        axiom: &Axiom,
        literal: &Literal,
        environment: &Environment,
    ) -> Vec<Sentence> {
        match self.ground(literal, environment) {
            Some((predicate, tuple)) => self.absent(predicate, &tuple),
            None => vec![self.speak(axiom, environment, |speaker| speaker.deny(literal))],
        }
    }

    /// A negated part without a match, in words.
    fn denied_part(&mut self, axiom: &Axiom, part: &Conjunction, environment: &Environment) -> Vec<Sentence> {
        if let ([(literal, _)], [], []) =
            (part.literals.as_slice(), part.without.as_slice(), part.variables.as_slice())
        {
            return self.denied_literal(axiom, literal, environment);
        }
        let none = Formula::from(part).negated();
        vec![self.speak(axiom, environment, |speaker| speaker.say(&none))]
    }

    /// The fact of a derived literal whose variables are all bound.
    fn ground(&self, literal: &Literal, environment: &Environment) -> Option<(PredicateId, Vec<NodeId>)> {
        let Literal::Derived { predicate, arguments, .. } = literal else { return None };
        let node = |term: &Term| match term {
            Term::Named(name) => self.query.snapshot.node(name),
            Term::Variable(variable) => environment.node(*variable),
        };
        Some((*predicate, arguments.iter().map(node).collect::<Option<_>>()?))
    }

    fn absent(&mut self, predicate: PredicateId, tuple: &[NodeId]) -> Vec<Sentence> {
        let key = (predicate, tuple.to_vec());
        if self.path.contains(&key) {
            return Vec::new();
        }
        self.path.push(key);
        let mut least: Option<Vec<Sentence>> = None;
        for axiom in self.axioms(predicate) {
            if !self.is_about(axiom, tuple) {
                continue;
            }
            for part in &axiom.body {
                let said = self.lacking(axiom, part, tuple);
                // An alternative without a sentence depends only on itself, and explains nothing.
                if !said.is_empty() && least.as_ref().is_none_or(|least| said.len() < least.len()) {
                    least = Some(said);
                }
            }
        }
        self.path.pop();
        least.unwrap_or_default()
    }

    /// Whether the nodes have the types of the axiom's parameters.
    fn is_about(&self, axiom: &Axiom, tuple: &[NodeId]) -> bool {
        let vocabulary = self.query.snapshot.vocabulary();
        axiom.scope.parameters().zip(tuple).all(|(variable, &node)| {
            let of = self.query.snapshot.get(node).map(|view| view.node_type());
            of.is_some_and(|of| axiom.scope.slot(variable).types.iter().any(|&id| vocabulary.is_a(of, id)))
        })
    }

    /// What an alternative lacks for a head: the literals that fail, in the order of the source.
    fn lacking(&mut self, axiom: &Axiom, part: &Conjunction, tuple: &[NodeId]) -> Vec<Sentence> {
        let mut frontier = vec![self.head(axiom, tuple)];
        let mut said = Vec::new();
        for (literal, span) in &part.literals {
            let alone = Conjunction {
                variables: part.variables.clone(),
                literals: vec![(literal.clone(), *span)],
                without: Vec::new(),
            };
            let mut next = Vec::new();
            for environment in &frontier {
                self.extend(&alone, environment, &mut next);
            }
            if next.is_empty() {
                add(&mut said, self.denied_literal(axiom, literal, &frontier[0].clone()));
            } else {
                frontier = next;
            }
        }
        for without in &part.without {
            let free: Vec<Environment> = frontier
                .iter()
                .filter(|environment| !self.query.matches(without, environment))
                .cloned()
                .collect();
            if free.is_empty() {
                let blocking = self.first(without, &[], frontier[0].clone());
                if let Some(environment) = blocking {
                    add(&mut said, self.affirmed(axiom, without, &environment));
                }
            } else {
                frontier = free;
            }
        }
        said
    }

    /// The completions of an environment that make one literal hold.
    fn extend(&self, alone: &Conjunction, environment: &Environment, next: &mut Vec<Environment>) {
        let literal = &alone.literals[0].0;
        let unbound: Vec<_> =
            literal.variables().filter(|&variable| environment.node(variable).is_none()).collect();
        let narrowed = Conjunction {
            variables: alone.variables.iter().filter(|(v, _)| unbound.contains(v)).copied().collect(),
            ..alone.clone()
        };
        let _ = self.query.solve(&narrowed, &[], &mut environment.clone(), &mut |found| {
            next.push(found.clone());
            if next.len() < FRONTIER { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
    }

    fn speak(
        &self,
        axiom: &Axiom,
        environment: &Environment,
        say: impl FnOnce(&Speaker<'_>) -> Sentence,
    ) -> Sentence {
        let name_of = |variable| self.query.snapshot.name(environment.node(variable)?).map(str::to_owned);
        let vocabulary = &self.seen.perception.vocabulary;
        say(&Speaker { vocabulary, scope: &axiom.scope, name_of: &name_of })
    }
}

/// Adds the sentences that are new.
fn add(said: &mut Vec<Sentence>, more: Vec<Sentence>) {
    for sentence in more {
        if !said.contains(&sentence) {
            said.push(sentence);
        }
    }
}

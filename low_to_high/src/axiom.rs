//! An axiom, compiled: the alternatives of its body, and the literals on which it depends.
//!
//! Idea: whether a head instance holds depends only on the ground instances of the body's literals under that head. So a
//! change of a ground token can change only the heads that agree with it wherever the literal names a parameter of the
//! head. A [`Dependency`] keeps, for each literal, which parameter is at which end. This is true for literals at any
//! depth of negation and quantification.

use dsr::{AttributeId, LabelId, TypeId};
use pddl::model::{Idx, Name, PredicateId};
use vocabulary::{Conjunction, Holder, Literal, Right, Scope, Term};

/// A compiled axiom.
#[derive(Debug)]
pub(crate) struct Axiom {
    pub(crate) predicate: PredicateId,
    pub(crate) scope: Scope,
    /// The alternatives of the body.
    pub(crate) body: Vec<Conjunction>,
    pub(crate) dependencies: Vec<Dependency>,
    /// The types over which a parameter or a quantified variable ranges.
    pub(crate) types: Vec<TypeId>,
    /// The nodes that it mentions by name.
    pub(crate) constants: Vec<Name>,
}

/// The kind of change that can change a literal.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Token {
    Label(LabelId),
    Attribute(AttributeId),
    Transforms,
    Predicate(PredicateId),
}

/// An argument of a literal, as seen from the head.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Place {
    /// This parameter of the head.
    Head(usize),
    /// The node of that name.
    Named(Name),
    /// A quantified variable: any node.
    Any,
}

/// A literal of the body, on which the axiom depends.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Dependency {
    pub(crate) token: Token,
    /// One per argument of the token.
    pub(crate) places: Vec<Place>,
}

impl Axiom {
    pub(crate) fn new(predicate: PredicateId, scope: Scope, body: Vec<Conjunction>) -> Self {
        let mut axiom = Self {
            predicate,
            scope,
            body: Vec::new(),
            dependencies: Vec::new(),
            types: Vec::new(),
            constants: Vec::new(),
        };
        let parameters = axiom.scope.parameters();
        axiom.types.extend(parameters.flat_map(|variable| axiom.scope.slot(variable).types.clone()));
        body.iter().for_each(|part| axiom.add_part(part));
        axiom.types.sort_unstable();
        axiom.types.dedup();
        axiom.body = body;
        axiom
    }

    /// The number of the head's parameters.
    pub(crate) fn arity(&self) -> usize {
        self.scope.parameters().count()
    }

    fn add_part(&mut self, part: &Conjunction) {
        self.types.extend(part.variables.iter().map(|(_, id)| *id));
        part.literals.iter().for_each(|(literal, _)| self.add_literal(literal));
        part.without.iter().for_each(|part| self.add_part(part));
    }

    fn add_literal(&mut self, literal: &Literal) {
        for term in literal.terms() {
            if let Term::Named(name) = term
                && !self.constants.contains(name)
            {
                self.constants.push(name.clone());
            }
        }
        match literal {
            Literal::Edge { from, label, to } => self.add(Token::Label(*label), &[from, to]),
            Literal::Present { holder, attribute } => self.add_attribute(holder, *attribute),
            Literal::Compare { holder, attribute, right, .. } => {
                self.add_attribute(holder, *attribute);
                if let Right::Attribute(holder, attribute) = right {
                    self.add_attribute(holder, *attribute);
                }
            }
            // A chain of transforms may pass through any frame, so the two ends do not restrict the head.
            Literal::Distance { .. } => self.add(Token::Transforms, &[]),
            Literal::Derived { predicate, arguments, .. } => {
                self.add(Token::Predicate(*predicate), &arguments.iter().collect::<Vec<_>>());
            }
            Literal::Same(..) | Literal::Differ(..) => {}
        }
    }

    fn add_attribute(&mut self, holder: &Holder, attribute: AttributeId) {
        self.add(Token::Attribute(attribute), &holder.terms());
    }

    fn add(&mut self, token: Token, terms: &[&Term]) {
        let place = |term: &&Term| match term {
            Term::Named(name) => Place::Named(name.clone()),
            Term::Variable(variable) if variable.index() < self.arity() => Place::Head(variable.index()),
            Term::Variable(_) => Place::Any,
        };
        let dependency = Dependency { token, places: terms.iter().map(place).collect() };
        if !self.dependencies.contains(&dependency) {
            self.dependencies.push(dependency);
        }
    }
}

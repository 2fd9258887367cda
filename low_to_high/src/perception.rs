//! `perception.pddl`, compiled.
//!
//! A head is a predicate of the planner's domain, which the file imports, or an auxiliary predicate that the file
//! declares. A body has tokens of the vocabulary, comparisons of attributes, and derived predicates, negated if stratified.

use std::sync::Arc;

use dsr::{Mentions, Vocabulary};
use pddl::Span;
use pddl::model::{self, Domain, IndexVec, Name, PredicateId, Variables};
use vocabulary::{Conjunction, Literal, Located, Tokens};

use crate::axiom::{Axiom, Token};
use crate::measure::{self, Measure, Measured};
use crate::perception_error::{MAX_LITERALS, PerceptionError, PerceptionErrorKind};
use crate::strata::{Component, components};

/// Who reads a derived predicate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The planner: imported from its domain.
    HighLevel,
    /// Other axioms: declared in the perception itself.
    Auxiliary,
}

/// A derived predicate.
#[derive(Debug)]
pub(crate) struct Derived {
    pub(crate) name: Name,
    pub(crate) role: Role,
    /// Positions of its axioms.
    pub(crate) axioms: Vec<usize>,
}

/// The axioms of a test, compiled for the graphs of one vocabulary.
#[derive(Debug)]
pub struct Perception {
    pub(crate) vocabulary: Arc<Vocabulary>,
    /// By the perception's own ids. A predicate that no axiom derives has no axioms.
    pub(crate) predicates: IndexVec<PredicateId, Derived>,
    pub(crate) axioms: Vec<Axiom>,
    /// Each component comes after those on which it depends.
    pub(crate) components: Vec<Component>,
    pub(crate) measures: Vec<Measure>,
}

impl Perception {
    /// Compiles the axioms of a domain that imports the vocabulary and the planner's domain.
    ///
    /// # Errors
    /// Every axiom that cannot be evaluated.
    pub fn new(domain: &Domain, tokens: &Tokens) -> Result<Self, Vec<PerceptionError>> {
        let link = tokens.link(domain);
        let mut errors = Vec::new();
        let mut axioms = Vec::new();
        let mut spans = Vec::new();
        let mut predicates: IndexVec<PredicateId, Derived> = domain
            .predicates
            .iter()
            .map(|predicate| Derived {
                name: predicate.name.clone(),
                // An imported predicate has no place in this source.
                role: if predicate.span == Span::default() { Role::HighLevel } else { Role::Auxiliary },
                axioms: Vec::new(),
            })
            .collect();
        let mut compile = |id: PredicateId,
                           name: &Name,
                           variables: &Variables,
                           body: &model::Condition,
                           span| {
            let formula = link.scope(variables).and_then(|scope| Ok((link.formula(&scope, [body])?, scope)));
            let (formula, scope) = match formula {
                Ok(done) => done,
                Err(more) => {
                    errors.extend(more.into_iter().map(|error| Located::new(error.span, error.kind.into())));
                    return None;
                }
            };
            let kind = match formula.disjuncts(&scope) {
                None => PerceptionErrorKind::TooManyAlternatives { name: name.clone() },
                Some(body) if body.iter().any(too_long) => {
                    PerceptionErrorKind::TooLong { name: name.clone() }
                }
                Some(body) => {
                    spans.push(span);
                    axioms.push(Axiom::new(id, scope, body));
                    return Some(axioms.len() - 1);
                }
            };
            errors.push(Located::new(span, kind));
            None
        };
        let mut derives_token = Vec::new();
        for axiom in &domain.axioms {
            let name = predicates[axiom.predicate].name.clone();
            if tokens.is_token(&name) {
                derives_token.push(Located::new(axiom.span, PerceptionErrorKind::DerivesToken { name }));
                continue;
            }
            let position = compile(axiom.predicate, &name, &axiom.variables, &axiom.body, axiom.span);
            predicates[axiom.predicate].axioms.extend(position);
        }
        let mut measures: Vec<Measure> = Vec::new();
        let mut unmeasured = Vec::new();
        for function in &domain.derived_functions {
            let name = domain.functions[function.function].name.clone();
            let value = match measure::counted(function) {
                Some((variables, condition)) => {
                    let (role, axioms) = (Role::Auxiliary, Vec::new());
                    let id = predicates.push(Derived { name: name.clone(), role, axioms });
                    let position = compile(id, &name, &variables, condition, function.span);
                    predicates[id].axioms.extend(position);
                    Ok(Measured::Count(id))
                }
                None => measure::read(domain, tokens, function),
            };
            if measures.iter().any(|other| other.name == name) {
                let kind = PerceptionErrorKind::MeasuredTwice { name };
                unmeasured.push(Located::new(function.span, kind));
                continue;
            }
            match value {
                Ok(value) => {
                    measures.push(Measure { name, arity: function.variables.parameters, value });
                }
                Err(more) => unmeasured.extend(more),
            }
        }
        errors.append(&mut derives_token);
        errors.append(&mut unmeasured);
        let derived = |id: PredicateId| domain.axioms.iter().any(|axiom| axiom.predicate == id);
        for axiom in &axioms {
            for part in &axiom.body {
                never_holds(part, &derived, tokens.name(), &mut errors);
            }
        }
        let components = components(&axioms).unwrap_or_else(|(at, denied)| {
            let head = predicates[axioms[at].predicate].name.clone();
            let denied = predicates[denied].name.clone();
            errors.push(Located::new(spans[at], PerceptionErrorKind::NotStratified { head, denied }));
            Vec::new()
        });
        if !errors.is_empty() {
            errors.sort_by_key(|error| error.span);
            errors.dedup();
            return Err(errors);
        }
        Ok(Self { vocabulary: Arc::clone(tokens.vocabulary()), predicates, axioms, components, measures })
    }

    /// The derived predicates, in the order of their declaration.
    pub fn derived(&self) -> impl Iterator<Item = (&Name, Role)> {
        let derived = self.predicates.iter().filter(|predicate| !predicate.axioms.is_empty());
        derived.map(|predicate| (&predicate.name, predicate.role))
    }

    /// The functions whose values are sensed, with the value of a fluent of which the graph says nothing.
    pub fn numbers(&self) -> impl Iterator<Item = (&Name, Option<f64>)> {
        self.measures.iter().map(|measure| (&measure.name, measure.default()))
    }

    /// The tokens that the axioms read, and the nodes of all types, since facts speak in names. A delta that touches
    /// none of them changes no fact.
    pub fn mentions(&self) -> Mentions {
        let mut mentions = Mentions::default();
        self.vocabulary.types().for_each(|id| mentions.add_type(id));
        for dependency in self.axioms.iter().flat_map(|axiom| &axiom.dependencies) {
            match dependency.token {
                Token::Label(label) => mentions.add_label(label),
                Token::Attribute(attribute) => mentions.add_attribute(attribute),
                Token::Transforms => mentions.add_transforms(),
                Token::Predicate(_) => {}
            }
        }
        for measure in &self.measures {
            if let Measured::Attribute { attribute, .. } = measure.value {
                mentions.add_attribute(attribute);
            }
        }
        mentions
    }

    /// The derived predicate of that name.
    pub(crate) fn find(&self, name: &str) -> Option<PredicateId> {
        let named = |(_, predicate): &(PredicateId, &Derived)| &*predicate.name == name;
        self.predicates
            .enumerate()
            .find(named)
            .filter(|(_, found)| !found.axioms.is_empty())
            .map(|(id, _)| id)
    }
}

fn too_long(part: &Conjunction) -> bool {
    part.literals.len() + part.without.len() > MAX_LITERALS || part.without.iter().any(too_long)
}

fn never_holds(
    part: &Conjunction,
    derived: &dyn Fn(PredicateId) -> bool,
    vocabulary: &Name,
    errors: &mut Vec<PerceptionError>,
) {
    for (literal, span) in &part.literals {
        if let Literal::Derived { predicate, name, .. } = literal
            && !derived(*predicate)
        {
            let (name, vocabulary) = (name.clone(), vocabulary.clone());
            errors.push(Located::new(*span, PerceptionErrorKind::NeverHolds { name, vocabulary }));
        }
    }
    part.without.iter().for_each(|part| never_holds(part, derived, vocabulary, errors));
}

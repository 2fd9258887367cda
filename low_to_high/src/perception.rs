//! `perception.pddl`, compiled.
//!
//! A head is a predicate of the planner's domain, which the file imports, or an auxiliary predicate that the file
//! declares. A body has tokens of the vocabulary, comparisons of attributes, and derived predicates, negated if stratified.

use std::sync::Arc;

use dsr::{Mentions, Vocabulary};
use pddl::Span;
use pddl::model::{Domain, IndexVec, Name, PredicateId};
use vocabulary::{Conjunction, LinkErrorKind, Literal, Located, MAX_ALTERNATIVES, Tokens};

use crate::axiom::{Axiom, Token};
use crate::strata::{Component, components};

/// The most literals of one alternative: matching keeps them as bits.
const MAX_LITERALS: usize = 64;

/// Why an axiom cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum PerceptionErrorKind {
    /// Agents write tokens; an axiom cannot derive one.
    #[error("`{name}` is a token: agents write it, so that no axiom may derive it")]
    DerivesToken { name: Name },
    /// No agent writes it and no axiom derives it.
    #[error("`{name}` is neither a token of vocabulary `{vocabulary}` nor derived here: it never holds")]
    NeverHolds { name: Name, vocabulary: Name },
    /// It depends on its own absence.
    #[error("`{head}` depends on the absence of `{denied}`, which depends on `{head}`")]
    NotStratified { head: Name, denied: Name },
    /// Too many disjunctions.
    #[error("`{name}` has more than {MAX_ALTERNATIVES} alternatives")]
    TooManyAlternatives { name: Name },
    /// Too long.
    #[error("an alternative of `{name}` has more than {MAX_LITERALS} literals")]
    TooLong { name: Name },
    /// A part of it cannot be compiled.
    #[error(transparent)]
    Link(#[from] LinkErrorKind),
}

/// An axiom that cannot be evaluated.
pub type PerceptionError = Located<PerceptionErrorKind>;

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
        for axiom in &domain.axioms {
            let name = predicates[axiom.predicate].name.clone();
            if tokens.is_token(&name) {
                errors.push(Located::new(axiom.span, PerceptionErrorKind::DerivesToken { name }));
                continue;
            }
            let formula = link
                .scope(&axiom.variables)
                .and_then(|scope| Ok((link.formula(&scope, [&axiom.body])?, scope)));
            let (formula, scope) = match formula {
                Ok(done) => done,
                Err(more) => {
                    errors.extend(more.into_iter().map(|error| Located::new(error.span, error.kind.into())));
                    continue;
                }
            };
            let Some(body) = formula.disjuncts(&scope) else {
                errors.push(Located::new(axiom.span, PerceptionErrorKind::TooManyAlternatives { name }));
                continue;
            };
            if body.iter().any(too_long) {
                errors.push(Located::new(axiom.span, PerceptionErrorKind::TooLong { name }));
                continue;
            }
            predicates[axiom.predicate].axioms.push(axioms.len());
            spans.push(axiom.span);
            axioms.push(Axiom::new(axiom.predicate, scope, body));
        }
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
        Ok(Self { vocabulary: Arc::clone(tokens.vocabulary()), predicates, axioms, components })
    }

    /// The derived predicates, in the order of their declaration.
    pub fn derived(&self) -> impl Iterator<Item = (&Name, Role)> {
        let derived = self.predicates.iter().filter(|predicate| !predicate.axioms.is_empty());
        derived.map(|predicate| (&predicate.name, predicate.role))
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

//! The door for domains that import a vocabulary: what they say, read as graph.
//!
//! Ids are each domain's own, so everything is linked by name, once, when a schema is compiled. Nodes are looked up
//! by name in each snapshot, because tests and worlds bring objects of their own.

use dsr::PatternError;
use pddl::Span;
use pddl::model::{self, Domain, Name, VariableId, Variables};

use crate::condition::Condition;
use crate::disjuncts::MAX_ALTERNATIVES;
use crate::effect::Effect;
use crate::expectation;
use crate::formula::Formula;
use crate::located::Located;
use crate::lower_effect;
use crate::scope::{Scope, Slot};
use crate::tokens::{Sort, Tokens};
use crate::translate::{Derived, Translator};

/// Why a condition or an effect cannot be read as graph.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum LinkErrorKind {
    /// The predicate cannot stand in the graph.
    #[error("`{name}` is no token of vocabulary `{vocabulary}`")]
    NotAToken { name: Name, vocabulary: Name },
    /// A type as a predicate: variables and nodes have their types already.
    #[error("types cannot be asked for here")]
    TypeCondition,
    /// The function cannot stand in the graph.
    #[error("`{name}` is no attribute of vocabulary `{vocabulary}`")]
    NotAnAttribute { name: Name, vocabulary: Name },
    /// The type is not one of nodes of the graph.
    #[error("`?{variable}`: `{name}` is no type of vocabulary `{vocabulary}`")]
    UnknownType { variable: Name, name: Name, vocabulary: Name },
    /// Values can be written, not asked for.
    #[error("`?{variable}` stands for a value; a condition is about nodes")]
    ValueVariable { variable: Name },
    /// A value stands where a node is meant.
    #[error("`{name}` is a value, not a node")]
    ValueTerm { name: Name },
    /// A pose has no equality.
    #[error("`{name}` is a pose; compare `distance` instead")]
    PoseComparison { name: Name },
    /// Initial poses are no attributes.
    #[error("`{name}` is a part of an initial pose; the graph has the whole pose as `rt`")]
    PosePart { name: Name },
    /// The graph compares an attribute with a number or with an attribute, a distance with a number.
    #[error(
        "this comparison is beyond the graph: it compares an attribute with a number or an attribute, or a \
             distance with a number"
    )]
    Comparison,
    /// `?duration`, `total-time` and divisions by zero have no value here.
    #[error("this has no value here")]
    NoValue,
    /// Too many disjunctions.
    #[error("more than {MAX_ALTERNATIVES} alternatives")]
    TooManyAlternatives,
    /// The graph computes it.
    #[error("`{name}` is computed by the graph, nobody can write it")]
    Computed { name: Name },
    /// A function is given what it cannot hold.
    #[error("`{name}` cannot be given this value")]
    WrongValue { name: Name },
    /// What shall be seen must be said without looking at what is.
    #[error("this cannot be awaited: the result depends on the present value")]
    NotExpectable,
    /// The graph can never match it.
    #[error("never matches: {0}")]
    Pattern(#[from] PatternError),
}

/// A part of a schema that cannot be read as graph.
pub type LinkError = Located<LinkErrorKind>;

/// A vocabulary and a domain that imports it.
#[derive(Debug, Clone, Copy)]
pub struct Link<'a> {
    pub(crate) tokens: &'a Tokens,
    pub(crate) domain: &'a Domain,
}

impl<'a> Link<'a> {
    pub(crate) fn new(tokens: &'a Tokens, domain: &'a Domain) -> Self {
        Self { tokens, domain }
    }

    /// The vocabulary.
    pub fn tokens(&self) -> &'a Tokens {
        self.tokens
    }

    /// The importing domain.
    pub fn domain(&self) -> &'a Domain {
        self.domain
    }

    /// The variables of a schema with their types in the graph.
    pub fn scope(&self, variables: &Variables) -> Result<Scope, Vec<LinkError>> {
        let mut errors = Vec::new();
        let slots = variables.slots.iter().map(|variable| self.slot(variable, &mut errors)).collect();
        let scope = Scope { slots, parameters: variables.parameters };
        if errors.is_empty() { Ok(scope) } else { Err(errors) }
    }

    fn slot(&self, variable: &model::Variable, errors: &mut Vec<LinkError>) -> Slot {
        let mut slot = Slot { name: variable.name.clone(), types: Vec::new(), value: None };
        for &id in &variable.types.0 {
            let name = &self.domain.types[id].name;
            match self.tokens.sort(name) {
                Some(Sort::Node(id)) => slot.types.push(id),
                Some(Sort::Value(sort)) => slot.value = Some(sort),
                None => errors.push(Located::new(
                    variable.span,
                    LinkErrorKind::UnknownType {
                        variable: variable.name.clone(),
                        name: name.clone(),
                        vocabulary: self.tokens.name.clone(),
                    },
                )),
            }
        }
        let vocabulary = &self.tokens.vocabulary;
        let all = slot.types.clone();
        slot.types.sort_unstable();
        slot.types.dedup();
        slot.types.retain(|&id| !all.iter().any(|&other| other != id && vocabulary.is_a(id, other)));
        slot
    }

    /// The conjunction of some conditions, as patterns of the graph.
    pub fn condition<'c>(
        &self,
        variables: &Variables,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
    ) -> Result<Condition, Vec<LinkError>> {
        let scope = self.scope(variables)?;
        let formula = self.translate(&scope, conditions, Derived::Refused)?;
        self.compile(&scope, &formula)
    }

    /// The conjunction of some conditions, as logic: predicates that are no tokens are allowed, and left to whoever
    /// evaluates it.
    pub fn formula<'c>(
        &self,
        scope: &Scope,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
    ) -> Result<Formula, Vec<LinkError>> {
        self.translate(scope, conditions, Derived::Allowed)
    }

    /// All of some effects, as edits of the graph.
    pub fn effect<'c>(
        &self,
        variables: &Variables,
        effects: impl IntoIterator<Item = &'c model::Effect>,
    ) -> Result<Effect, Vec<LinkError>> {
        lower_effect::lower(self, self.scope(variables)?, effects)
    }

    /// The condition that the result of some effects can be seen in the graph.
    pub fn expectation<'c>(
        &self,
        variables: &Variables,
        effects: impl IntoIterator<Item = &'c model::Effect>,
    ) -> Result<Condition, Vec<LinkError>> {
        let scope = self.scope(variables)?;
        let formula = expectation::formula(self, &scope, effects)?;
        self.compile(&scope, &formula)
    }

    fn translate<'c>(
        &self,
        scope: &Scope,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
        derived: Derived,
    ) -> Result<Formula, Vec<LinkError>> {
        let mut translator = Translator::new(*self, scope, derived);
        let parts = conditions.into_iter().map(|condition| translator.condition(condition)).collect();
        translator.finish(Formula::All(parts))
    }

    fn compile(&self, scope: &Scope, formula: &Formula) -> Result<Condition, Vec<LinkError>> {
        let mut bound: Vec<VariableId> = scope.parameters().filter(|&v| scope.is_node(v)).collect();
        bound.extend(formula.free());
        bound.sort_unstable();
        bound.dedup();
        Condition::compile(&self.tokens.vocabulary, scope, formula, &bound).map_err(|error| vec![error])
    }

    pub(crate) fn not_an_attribute(&self, name: &Name, span: Span) -> LinkError {
        let (name, vocabulary) = (name.clone(), self.tokens.name.clone());
        Located::new(span, LinkErrorKind::NotAnAttribute { name, vocabulary })
    }
}

//! Compiling the schemas of a domain that imports a vocabulary.
//!
//! Each domain has ids of its own, so a schema is linked by name, once, when it is compiled. Nodes are looked up by name
//! in each snapshot, because tests and worlds bring objects of their own.

use dsr::AttributeId;
use pddl::model::{self, Domain, VariableId, Variables};

use crate::condition::Condition;
use crate::effect::Effect;
use crate::expectation;
use crate::formula::{Formula, Holder};
use crate::link_error::{LinkError, LinkErrorKind};
use crate::located::Located;
use crate::lower_effect;
use crate::scope::{Scope, Slot};
use crate::tokens::{Sort, Tokens};
use crate::translate::{Derived, Translator};

/// A vocabulary and a domain that imports it.
#[derive(Debug, Clone, Copy)]
pub struct Link<'a> {
    tokens: &'a Tokens,
    domain: &'a Domain,
}

impl Tokens {
    /// Links a domain that imports this vocabulary.
    pub fn link<'a>(&'a self, domain: &'a Domain) -> Link<'a> {
        Link { tokens: self, domain }
    }
}

impl Link<'_> {
    /// The variables of a schema, with their types in the graph.
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

    /// Compiles the conjunction of some conditions to patterns of the graph.
    pub fn condition<'c>(
        &self,
        variables: &Variables,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
    ) -> Result<Condition, Vec<LinkError>> {
        let scope = self.scope(variables)?;
        let formula = self.translate(&scope, conditions, Derived::Refused)?;
        self.compile(&scope, &formula)
    }

    /// Translates the conjunction of some conditions to logic. Predicates that are not tokens are allowed; the caller
    /// evaluates them.
    pub fn formula<'c>(
        &self,
        scope: &Scope,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
    ) -> Result<Formula, Vec<LinkError>> {
        self.translate(scope, conditions, Derived::Allowed)
    }

    /// The attribute of a node or an edge that an application names.
    pub fn attribute(
        &self,
        scope: &Scope,
        application: &model::Application,
    ) -> Result<(Holder, AttributeId), Vec<LinkError>> {
        let mut translator = Translator::new(self.tokens, self.domain, scope, Derived::Refused);
        let found = translator.attribute(application);
        translator.finish(())?;
        Ok(found.expect("an application that is no attribute was reported"))
    }

    /// Compiles some effects to edits of the graph.
    pub fn effect<'c>(
        &self,
        variables: &Variables,
        effects: impl IntoIterator<Item = &'c model::Effect>,
    ) -> Result<Effect, Vec<LinkError>> {
        lower_effect::lower(self.tokens, self.domain, self.scope(variables)?, effects)
    }

    /// Compiles the condition under which the result of some effects can be seen in the graph.
    pub fn expectation<'c>(
        &self,
        variables: &Variables,
        effects: impl IntoIterator<Item = &'c model::Effect>,
    ) -> Result<Condition, Vec<LinkError>> {
        let scope = self.scope(variables)?;
        let formula = expectation::formula(self.tokens, self.domain, &scope, effects)?;
        self.compile(&scope, &formula)
    }

    fn translate<'c>(
        &self,
        scope: &Scope,
        conditions: impl IntoIterator<Item = &'c model::Condition>,
        derived: Derived,
    ) -> Result<Formula, Vec<LinkError>> {
        let mut translator = Translator::new(self.tokens, self.domain, scope, derived);
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
}

//! Rules of reachability: the body to join, and the heads that follow.

use super::filter::Filter;
use crate::ground::normalise::{Fluents, Formula, Literal, Product, Schema};
use pddl::model::{Extent, Idx, PredicateId, Term, VariableId};
use std::sync::Arc;

/// A positive atom of a body.
#[derive(Clone, Debug)]
pub(crate) struct BodyAtom {
    pub(crate) predicate: PredicateId,
    pub(crate) arguments: Box<[Term]>,
}

/// `heads` are reachable if `body` is reachable and the filters hold.
#[derive(Clone, Debug)]
pub(crate) struct Rule {
    pub(crate) schema: usize,
    pub(crate) slots: Vec<Arc<Extent>>,
    /// The variables that must be bound.
    pub(crate) variables: Vec<VariableId>,
    pub(crate) body: Vec<BodyAtom>,
    pub(crate) filters: Vec<Filter>,
    pub(crate) heads: Vec<(PredicateId, Box<[Term]>)>,
    /// Whether its bindings are the schema's instances.
    pub(crate) collected: bool,
}

impl Rule {
    fn new(schema: usize, of: &Schema, is_static: &[bool], fluents: &Fluents) -> Self {
        let mut variables: Vec<VariableId> = (0..of.parameters).map(VariableId::from_index).collect();
        variables.extend(&of.hoisted);
        let mut rule = Self {
            schema,
            slots: of.slots.clone(),
            variables,
            body: Vec::new(),
            filters: Vec::new(),
            heads: Vec::new(),
            collected: false,
        };
        rule.require(&of.condition, is_static, fluents);
        rule
    }

    /// Adds the conjuncts that a join can use. The others are ignored, which over-approximates.
    fn require(&mut self, formula: &Formula, is_static: &[bool], fluents: &Fluents) {
        for conjunct in formula.conjuncts() {
            match conjunct {
                Formula::Literal(Literal { positive: true, predicate, arguments }) => {
                    self.body.push(BodyAtom { predicate: *predicate, arguments: arguments.clone() });
                }
                Formula::Literal(Literal { positive: false, predicate, arguments })
                    if is_static[predicate.index()] =>
                {
                    self.filters.push(Filter::Absent { predicate: *predicate, arguments: arguments.clone() });
                }
                &Formula::Same { positive, left, right } => {
                    self.filters.push(Filter::Same { positive, left, right });
                }
                Formula::OneOf { positive, term, extent } => {
                    let (positive, term, extent) = (*positive, *term, extent.clone());
                    self.filters.push(Filter::OneOf { positive, term, extent });
                }
                Formula::Compare { relation, left, right }
                    if fluents.is_static(left) && fluents.is_static(right) =>
                {
                    let (relation, left, right) = (*relation, left.clone(), right.clone());
                    self.filters.push(Filter::Compare { relation, left, right });
                }
                _ => {}
            }
        }
    }
}

/// The rules of all schemas.
pub(crate) fn rules(schemas: &[Schema], is_static: &[bool], fluents: &Fluents) -> Vec<Rule> {
    let mut found = Vec::new();
    for (i, schema) in schemas.iter().enumerate().filter(|(_, s)| !s.condition.is_refuted()) {
        let mut main = Rule::new(i, schema, is_static, fluents);
        main.collected = true;
        match &schema.product {
            Product::Axiom { predicate, arguments } => main.heads.push((*predicate, arguments.clone())),
            Product::Action { effects, .. } => {
                for effect in effects.iter().filter(|e| e.positive) {
                    let head = (effect.predicate, effect.arguments.clone());
                    if effect.is_simple() {
                        main.heads.push(head);
                    } else if !effect.condition.is_refuted() {
                        let mut rule = Rule::new(i, schema, is_static, fluents);
                        rule.require(&effect.condition, is_static, fluents);
                        rule.variables.extend(&effect.quantified);
                        rule.heads.push(head);
                        found.push(rule);
                    }
                }
            }
        }
        found.push(main);
    }
    found
}

//! Normalises the model for the later stages.
//!
//! Object fluents become predicates (`values`), conditions get negation normal form (`formula`),
//! actions and axioms become schemas (`schema`), constant numeric fluents become a table
//! (`fluents`), and the metric becomes operator costs (`cost`). In: a domain and a problem that
//! forward search supports. Out: [`Normalised`].

mod cost;
mod fluents;
mod formula;
mod schema;
mod universe;
mod values;

pub(crate) use cost::{CostModel, Measure, NoCost, metric_span};
pub(crate) use fluents::{Fluents, Key, STEPS};
pub(crate) use formula::{Formula, Literal};
pub(crate) use schema::{NumericEffects, Product, Schema, SchemaEffect};
pub(crate) use universe::Universe;
pub(crate) use values::compile;

use super::error::{GroundError, Origin};
use crate::task::ValuePredicates;
use pddl::model::{Domain, EffectKind, Extent, FunctionId, Idx, PredicateId, Problem};
use std::sync::Arc;

/// What outside events change.
#[derive(Clone, Copy, Default)]
pub(crate) struct Outside<'m> {
    pub(crate) predicates: &'m [PredicateId],
    pub(crate) functions: &'m [FunctionId],
    /// Predicates whose facts are kept although nothing reads them.
    pub(crate) kept: &'m [PredicateId],
}

/// A model without object fluents, in normal form.
pub(crate) struct Normalised<'m> {
    pub(crate) domain: &'m Domain,
    pub(crate) problem: &'m Problem,
    /// Predicates that outside events change.
    pub(crate) exogenous: &'m [PredicateId],
    /// Predicates whose facts nothing needs to read.
    pub(crate) kept: &'m [PredicateId],
    /// The predicates that stand for object fluents.
    pub(crate) values: ValuePredicates,
    /// By predicate: whether no action, axiom or outside event changes it.
    pub(crate) is_static: Vec<bool>,
    pub(crate) fluents: Fluents,
    pub(crate) costs: CostModel,
    /// Actions in their order, then the rules of axioms.
    pub(crate) schemas: Vec<Schema>,
    pub(crate) goal: Formula,
    pub(crate) goal_slots: Vec<Arc<Extent>>,
}

/// Normalises a model without object fluents. `additive`: whether to try a sum of operator costs.
pub(crate) fn normalise<'m>(
    domain: &'m Domain,
    problem: &'m Problem,
    outside: Outside<'m>,
    values: ValuePredicates,
    additive: bool,
) -> Result<Normalised<'m>, GroundError> {
    let exogenous = outside.predicates;
    let mut fluents = Fluents::new(domain, problem, outside.functions)?;
    let costs = CostModel::new(domain, problem, &fluents, additive);
    if let Measure::Value(metric) = &costs.measure {
        fluents.reads(&metric.expression, Origin::Problem)?;
    }
    let mut universe = Universe::new(domain, problem);
    let schemas = schema::schemas(domain, &mut universe, &costs, &fluents)?;
    let goal = Formula::of(&problem.goal, true, Origin::Problem, &mut universe)?;
    let goal_slots = universe.slots(&problem.goal_variables);
    let is_static = static_predicates(domain, exogenous);
    Ok(Normalised {
        domain,
        problem,
        exogenous,
        kept: outside.kept,
        values,
        is_static,
        fluents,
        costs,
        schemas,
        goal,
        goal_slots,
    })
}

/// By predicate: whether nothing changes it.
fn static_predicates(domain: &Domain, exogenous: &[PredicateId]) -> Vec<bool> {
    let mut is_static = vec![true; domain.predicates.len()];
    for action in &domain.actions {
        action.effect.each(&mut |part| {
            if let EffectKind::Add(atom) | EffectKind::Delete(atom) = &part.kind {
                is_static[atom.predicate.index()] = false;
            }
        });
    }
    domain.axioms.iter().for_each(|a| is_static[a.predicate.index()] = false);
    exogenous.iter().for_each(|p| is_static[p.index()] = false);
    is_static
}

//! Action and axiom schemas, normalised for the join.

use super::budget;
use super::cost::{CostModel, CostTerm};
use super::error::{Feature, GroundError, Origin};
use super::formula::Formula;
use super::universe::{Range, Universe};
use pddl::model::{Action, ActionId, Axiom, Domain, Effect, EffectKind, Name, PredicateId, Term, VariableId};
use std::sync::Arc;

/// An effect under its quantifiers and conditions.
#[derive(Clone, Debug)]
pub(crate) struct SchemaEffect {
    pub(crate) quantified: Vec<VariableId>,
    pub(crate) condition: Formula,
    pub(crate) positive: bool,
    pub(crate) predicate: PredicateId,
    pub(crate) arguments: Box<[Term]>,
}

impl SchemaEffect {
    pub(crate) fn is_simple(&self) -> bool {
        self.quantified.is_empty() && self.condition.conjuncts().is_empty()
    }
}

/// What a schema's instances are.
#[derive(Clone, Debug)]
pub(crate) enum Product {
    /// Operators.
    Action { id: ActionId, effects: Vec<SchemaEffect>, costs: Vec<CostTerm> },
    /// Rules for this head.
    Axiom { predicate: PredicateId, arguments: Box<[Term]> },
}

/// A normalised schema.
#[derive(Clone, Debug)]
pub(crate) struct Schema {
    pub(crate) name: Name,
    pub(crate) slots: Vec<Arc<Range>>,
    pub(crate) parameters: usize,
    /// Existential variables of the top level.
    pub(crate) hoisted: Vec<VariableId>,
    pub(crate) condition: Formula,
    pub(crate) product: Product,
}

impl Schema {
    /// Bytes that an instance takes at least.
    pub(crate) fn instance_bytes(&self) -> usize {
        let effects = match &self.product {
            Product::Action { effects, .. } => effects.iter().map(|e| 1 + e.condition.leaves()).sum(),
            Product::Axiom { .. } => 1,
        };
        budget::instance(self.parameters + self.hoisted.len(), self.condition.leaves() + effects)
    }
}

/// Disjuncts of an axiom's body that become rules of their own.
const RULES_PER_AXIOM: usize = 32;

/// All schemas of a domain.
pub(crate) fn schemas(
    domain: &Domain,
    universe: &mut Universe<'_>,
    costs: &CostModel<'_>,
) -> Result<Vec<Schema>, GroundError> {
    let mut found = Vec::new();
    for (id, action) in domain.actions.enumerate() {
        found.push(of_action(id, action, universe, costs)?);
    }
    for axiom in &domain.axioms {
        of_axiom(domain, axiom, universe, &mut found)?;
    }
    Ok(found)
}

fn of_action(
    id: ActionId,
    action: &Action,
    universe: &mut Universe<'_>,
    costs: &CostModel<'_>,
) -> Result<Schema, GroundError> {
    let mut hoisted = Vec::new();
    let condition = Formula::of(&action.precondition, true, Origin::Domain, universe)?.hoisted(&mut hoisted);
    let mut product = (Vec::new(), Vec::new());
    collect(&action.effect, &[], &Formula::always(), costs, universe, &mut product)?;
    let (effects, costs) = product;
    Ok(Schema {
        name: action.name.clone(),
        slots: universe.slots(&action.variables),
        parameters: action.variables.parameters,
        hoisted,
        condition,
        product: Product::Action { id, effects, costs },
    })
}

fn of_axiom(
    domain: &Domain,
    axiom: &Axiom,
    universe: &mut Universe<'_>,
    found: &mut Vec<Schema>,
) -> Result<(), GroundError> {
    let slots = universe.slots(&axiom.variables);
    for disjunct in Formula::of(&axiom.body, true, Origin::Domain, universe)?.disjuncts(RULES_PER_AXIOM) {
        let mut hoisted = Vec::new();
        let condition = disjunct.hoisted(&mut hoisted);
        found.push(Schema {
            name: domain.predicates[axiom.predicate].name.clone(),
            slots: slots.clone(),
            parameters: axiom.variables.parameters,
            hoisted,
            condition,
            product: Product::Axiom {
                predicate: axiom.predicate,
                arguments: axiom.variables.parameter_ids().map(Term::Variable).collect(),
            },
        });
    }
    Ok(())
}

fn collect(
    effect: &Effect,
    quantified: &[VariableId],
    condition: &Formula,
    costs: &CostModel<'_>,
    universe: &mut Universe<'_>,
    out: &mut (Vec<SchemaEffect>, Vec<CostTerm>),
) -> Result<(), GroundError> {
    let mut push = |positive, atom: &pddl::model::Atom| {
        out.0.push(SchemaEffect {
            quantified: quantified.to_vec(),
            condition: condition.clone(),
            positive,
            predicate: atom.predicate,
            arguments: atom.arguments.clone().into(),
        });
    };
    match &effect.kind {
        EffectKind::And(parts) => {
            for part in parts {
                collect(part, quantified, condition, costs, universe, out)?;
            }
        }
        EffectKind::Add(atom) => push(true, atom),
        EffectKind::Delete(atom) => push(false, atom),
        EffectKind::Forall(vs, inner) => {
            let mut all = quantified.to_vec();
            all.extend(vs);
            collect(inner, &all, condition, costs, universe, out)?;
        }
        EffectKind::When(when, inner) => {
            let mut all = quantified.to_vec();
            let when = Formula::of(when, true, Origin::Domain, universe)?.hoisted(&mut all);
            let both = Formula::and(vec![condition.clone(), when]);
            collect(inner, &all, &both, costs, universe, out)?;
        }
        EffectKind::Assign(operator, application, value) => {
            let conditional = !quantified.is_empty() || !condition.conjuncts().is_empty();
            if let Some(term) = costs.effect(*operator, application, value, effect.span)? {
                if conditional {
                    return Err(GroundError::Unsupported {
                        feature: Feature::ConditionalCost,
                        origin: Origin::Domain,
                        span: effect.span,
                    });
                }
                out.1.push(term);
            }
        }
    }
    Ok(())
}

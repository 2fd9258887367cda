//! Action and axiom schemas, normalised for joins.

use super::cost::{CostModel, CostTerm};
use super::fluents::Fluents;
use super::formula::Formula;
use super::universe::Universe;
use crate::ground::error::{GroundError, Origin};
use crate::ground::memory;
use pddl::model::{
    Action, ActionId, Application, AssignOperator, AssignedValue, Axiom, Domain, Effect, EffectKind,
    Expression, Extent, Name, PredicateId, Term, VariableId,
};
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

/// A numeric effect under its quantifiers and conditions.
#[derive(Clone, Debug)]
pub(crate) struct NumericEffect {
    pub(crate) quantified: Vec<VariableId>,
    pub(crate) condition: Formula,
    pub(crate) operator: AssignOperator,
    pub(crate) fluent: Application,
    /// The new value; `None` makes the fluent undefined.
    pub(crate) value: Option<Expression>,
}

/// The numeric effects of an action.
#[derive(Clone, Debug, Default)]
pub(crate) struct NumericEffects {
    /// Effects on fluents that a condition or an expression reads.
    pub(crate) changes: Vec<NumericEffect>,
    /// Effects on fluents that nothing reads, with static expressions. Only their values must be defined.
    pub(crate) defined: Vec<(AssignOperator, Application, Expression)>,
}

/// What the instances of a schema become.
#[derive(Clone, Debug)]
pub(crate) enum Product {
    /// Operators.
    Action { id: ActionId, effects: Vec<SchemaEffect>, costs: Vec<CostTerm>, numbers: NumericEffects },
    /// Rules with this head.
    Axiom { predicate: PredicateId, arguments: Box<[Term]> },
}

/// A normalised schema.
#[derive(Clone, Debug)]
pub(crate) struct Schema {
    pub(crate) name: Name,
    pub(crate) slots: Vec<Arc<Extent>>,
    pub(crate) parameters: usize,
    /// Existential variables at the top level of the condition.
    pub(crate) hoisted: Vec<VariableId>,
    pub(crate) condition: Formula,
    pub(crate) product: Product,
}

impl Schema {
    /// A lower bound on the bytes of an instance.
    pub(crate) fn instance_bytes(&self) -> usize {
        let effects = match &self.product {
            Product::Action { effects, .. } => effects.iter().map(|e| 1 + e.condition.leaves()).sum(),
            Product::Axiom { .. } => 1,
        };
        memory::instance(self.parameters + self.hoisted.len(), self.condition.leaves() + effects)
    }
}

/// The most disjuncts of an axiom's body that become separate rules.
const RULES_PER_AXIOM: usize = 32;

/// All schemas of a domain.
pub(crate) fn schemas(
    domain: &Domain,
    universe: &mut Universe<'_>,
    costs: &CostModel,
    fluents: &Fluents,
) -> Result<Vec<Schema>, GroundError> {
    let mut found = Vec::new();
    for (id, action) in domain.actions.enumerate() {
        found.push(of_action(id, action, universe, costs, fluents)?);
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
    costs: &CostModel,
    fluents: &Fluents,
) -> Result<Schema, GroundError> {
    let mut hoisted = Vec::new();
    let condition = Formula::of(&action.precondition, true, Origin::Domain, universe)?.hoisted(&mut hoisted);
    let mut product = Collected::default();
    collect(&action.effect, &Around::nothing(), (costs, fluents), universe, &mut product)?;
    let Collected { effects, costs, numbers } = product;
    Ok(Schema {
        name: action.name.clone(),
        slots: universe.slots(&action.variables),
        parameters: action.variables.parameters,
        hoisted,
        condition,
        product: Product::Action { id, effects, costs, numbers },
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

#[derive(Default)]
struct Collected {
    effects: Vec<SchemaEffect>,
    costs: Vec<CostTerm>,
    numbers: NumericEffects,
}

/// The quantifiers and conditions around an effect. For an atom, the variables of existential
/// conditions are quantified like universal ones, because adding an atom once per witness changes
/// nothing. For a number this would be wrong: it must not be increased once per witness.
#[derive(Clone)]
struct Around {
    quantified: Vec<VariableId>,
    condition: Formula,
    universal: Vec<VariableId>,
    exact: Formula,
}

impl Around {
    fn nothing() -> Self {
        let always = Formula::always;
        Self { quantified: Vec::new(), condition: always(), universal: Vec::new(), exact: always() }
    }
}

fn collect(
    effect: &Effect,
    around: &Around,
    models: (&CostModel, &Fluents),
    universe: &mut Universe<'_>,
    out: &mut Collected,
) -> Result<(), GroundError> {
    let mut push = |positive, atom: &pddl::model::Atom| {
        out.effects.push(SchemaEffect {
            quantified: around.quantified.clone(),
            condition: around.condition.clone(),
            positive,
            predicate: atom.predicate,
            arguments: atom.arguments.clone().into(),
        });
    };
    match &effect.kind {
        EffectKind::And(parts) => {
            for part in parts {
                collect(part, around, models, universe, out)?;
            }
        }
        EffectKind::Add(atom) => push(true, atom),
        EffectKind::Delete(atom) => push(false, atom),
        EffectKind::Forall(vs, inner) => {
            let mut all = around.clone();
            all.quantified.extend(vs);
            all.universal.extend(vs);
            collect(inner, &all, models, universe, out)?;
        }
        EffectKind::When(when, inner) => {
            let mut all = around.clone();
            let when = Formula::of(when, true, Origin::Domain, universe)?;
            all.exact = Formula::and(vec![all.exact, when.clone()]);
            let when = when.hoisted(&mut all.quantified);
            all.condition = Formula::and(vec![all.condition, when]);
            collect(inner, &all, models, universe, out)?;
        }
        EffectKind::Assign(operator, application, value) => {
            let (costs, fluents) = models;
            out.costs.extend(costs.term(*operator, application, value));
            let value = match value {
                AssignedValue::Number(expression) => Some(expression.clone()),
                AssignedValue::Object(_) | AssignedValue::Undefined => None,
            };
            let simple = around.universal.is_empty() && around.exact.conjuncts().is_empty();
            match value {
                Some(value)
                    if simple && !fluents.is_tracked(application.function) && fluents.is_static(&value) =>
                {
                    out.numbers.defined.push((*operator, application.clone(), value));
                }
                value => out.numbers.changes.push(NumericEffect {
                    quantified: around.universal.clone(),
                    condition: around.exact.clone(),
                    operator: *operator,
                    fluent: application.clone(),
                    value,
                }),
            }
        }
    }
    Ok(())
}

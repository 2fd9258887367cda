//! Numeric effects and comparisons under a binding.
//!
//! Idea: a comparison of changing numbers is an atom like any other, except that numbers decide it.
//! Operators, goals, axioms and searches therefore need no special case for numeric conditions.
//! Conditions under which an action has no result (an undefined value, or two changes of one fluent
//! that disagree) are negated and added to its precondition. Invariant: an instance is applicable
//! exactly if its action is.

use super::fold::Instantiator;
use super::folded::Comparison;
use super::raw::RawChange;
use crate::ground::binding::{each_binding, resolve};
use crate::ground::literal::{Lit, consistent};
use crate::ground::normalise::{Fluents, Key, NumericEffects, Schema};
use crate::number::{Change, Expression, NoValue, Number, Relation};
use pddl::model::{AssignOperator, Expression as Written};

/// A change whose fluents are not numbered yet.
struct Instance {
    condition: Vec<Lit>,
    fluent: Key,
    change: Change,
    value: Option<Expression<Key>>,
}

/// The numeric effects of an instance of a schema. Adds the conjunctions under which they have no
/// result to `never`; `None` if they never have a result.
pub(super) fn changes(
    work: &mut Instantiator<'_>,
    schema: &Schema,
    effects: &NumericEffects,
    binding: &mut [u32],
    never: &mut Vec<Vec<Lit>>,
) -> Option<Vec<RawChange>> {
    let fluents = work.fluents;
    for (operator, application, value) in &effects.defined {
        let row = application.arguments.iter().map(|&t| resolve(t, binding)).collect();
        fluents.initial(&(application.function, row))?;
        let value = fluents.value(value, binding).ok()?;
        if *operator == AssignOperator::ScaleDown && value.is_zero() {
            return None;
        }
    }
    let mut instances: Vec<Instance> = Vec::new();
    for effect in &effects.changes {
        each_binding(&effect.quantified, &schema.slots, binding, &mut |binding| {
            let condition = work.fold(&effect.condition, &schema.slots, binding);
            let Some(condition) = work.conjunction(condition) else { return };
            let row = effect.fluent.arguments.iter().map(|&t| resolve(t, binding)).collect();
            let fluent = (effect.fluent.function, row);
            let (change, value) = match &effect.value {
                None => (Change::Assign, Ok(None)),
                Some(value) => {
                    let (change, value) = folded(effect.operator, value, fluents, binding);
                    (change, value.map(Some))
                }
            };
            match value {
                Ok(value) if change == Change::Assign || fluents.may_be_defined(&fluent) => {
                    instances.push(Instance { condition, fluent, change, value });
                }
                _ => never.push(condition),
            }
        });
    }
    for instance in &instances {
        undefined(work, instance, never);
    }
    for (i, first) in instances.iter().enumerate() {
        for second in instances[i + 1..].iter().filter(|s| s.fluent == first.fluent) {
            clash(work, first, second, never);
        }
    }
    if never.iter().any(Vec::is_empty) {
        return None;
    }
    // A fluent assigned the same value twice is assigned once.
    let mut found: Vec<RawChange> = Vec::new();
    for Instance { condition, fluent, change, value } in instances {
        let value = value.map(|value| work.numbers.expression(&value));
        let raw = RawChange { condition, fluent: work.numbers.fluent(&fluent), change, value };
        let again = found.iter().any(|known| {
            change == Change::Assign
                && known.change == change
                && known.fluent == raw.fluent
                && known.value == raw.value
                && known.condition == raw.condition
        });
        if !again {
            found.push(raw);
        }
    }
    Some(found)
}

fn folded(
    operator: AssignOperator,
    value: &Written,
    fluents: &Fluents,
    binding: &[u32],
) -> (Change, Result<Expression<Key>, NoValue>) {
    let value = fluents.fold(value, binding);
    match operator {
        AssignOperator::Assign => (Change::Assign, value),
        AssignOperator::Increase => (Change::Shift, value),
        AssignOperator::Decrease => (Change::Shift, value.and_then(Expression::negated)),
        AssignOperator::ScaleUp => (Change::Scale, value),
        AssignOperator::ScaleDown => {
            (Change::Scale, value.and_then(|value| Expression::constant(Number::ONE).over(value)))
        }
    }
}

/// Forbids states where the change reads a fluent without a value or divides by 0.
fn undefined(work: &mut Instantiator<'_>, instance: &Instance, never: &mut Vec<Vec<Lit>>) {
    let fluents = work.fluents;
    let mut must = Vec::new();
    if instance.change != Change::Assign && fluents.may_be_undefined(&instance.fluent) {
        must.push(Expression::fluent(instance.fluent.clone()));
    }
    if let Some(value) = &instance.value {
        let mut open = value.divides();
        value.each_fluent(&mut |key| open |= fluents.may_be_undefined(key));
        if open {
            must.push(value.clone());
        }
    }
    for expression in must {
        let atom = work.comparison(&Comparison { relation: Relation::Defined, expression });
        let both = instance.condition.iter().copied().chain([atom << 1 | 1]);
        never.extend(consistent(both.collect()));
    }
}

/// Forbids states where two changes of one fluent happen and disagree.
fn clash(work: &mut Instantiator<'_>, first: &Instance, second: &Instance, never: &mut Vec<Vec<Lit>>) {
    let mut both: Vec<Lit> = first.condition.iter().chain(&second.condition).copied().collect();
    match (first.change, second.change) {
        (Change::Shift, Change::Shift) | (Change::Scale, Change::Scale) => return,
        (Change::Assign, Change::Assign) => match (&first.value, &second.value) {
            (None, None) => return,
            (Some(a), Some(b)) => {
                let Ok(expression) = a.clone().minus(b.clone()) else { return };
                match expression.as_constant() {
                    Some(difference) if difference.is_zero() => return,
                    Some(_) => {}
                    None => {
                        let differ = Comparison { relation: Relation::NonZero, expression };
                        both.push(work.comparison(&differ) << 1);
                    }
                }
            }
            _ => {}
        },
        _ => {}
    }
    never.extend(consistent(both));
}

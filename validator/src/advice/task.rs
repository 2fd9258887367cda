//! Changes of the task: an initial fact added or removed, another initial value, or one literal less in a
//! precondition.

use super::apply::take_away;
use super::change::Repair;
use super::trials::Trials;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::PlanRef;
use crate::validator::Validator;
use crate::value::Value;
use crate::verdict::{Failure, Operand, Unsatisfied};
use pddl::model::{Comparison, GroundApplication};
use pddl::{Span, StepHead};

pub(super) fn repairs(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, failure: &Failure) -> Vec<Repair> {
    // Adding the goal itself to the initial state would not be helpful.
    if matches!(failure, Failure::Goal { .. } | Failure::Constraint { .. }) {
        return Vec::new();
    }
    let mut candidates = Vec::new();
    Unsatisfied::each(failure.parts(), &mut |part| match part {
        Unsatisfied::Missing { atom, derived: false, deleted_by: None, .. } => {
            candidates.push(Repair::Initially(atom.clone()));
        }
        Unsatisfied::Present { atom, derived: false, added_by: None, .. } => {
            candidates.push(Repair::NotInitially(atom.clone()));
        }
        Unsatisfied::Comparison { comparison, wanted: true, left, right, .. } => {
            values(trials.validator, *comparison, left, right, &mut candidates);
        }
        _ => {}
    });
    let mut found = Vec::new();
    for repair in candidates {
        if found.len() >= trials.budget.offers {
            return found;
        }
        if begins_well(trials, plan, &repair) {
            found.push(repair);
        }
    }
    found
}

/// A part of the failing step's condition without which the plan passes. This is the last resort, because a condition
/// is rarely a mistake.
pub(super) fn weaker(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, failure: &Failure) -> Option<Repair> {
    let Failure::Precondition { at, .. } = failure else { return None };
    // Only a top-level part of the condition can be removed alone; a nested part cannot.
    let span =
        failure.parts().iter().map(Unsatisfied::span).find(|&span| without(trials, plan, *at, span))?;
    Some(Repair::Without { span })
}

/// Whether the plan passes from the repaired initial state.
fn begins_well(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, repair: &Repair) -> bool {
    let mut changed: Validator<'_> = trials.validator.clone();
    let initial = &mut changed.prepared.initial;
    match repair {
        Repair::Initially(atom) => {
            initial.facts[atom.predicate].add(&atom.arguments, 0);
        }
        Repair::NotInitially(atom) => {
            // Any moment but 0: at the same moment, the add of the initial fact would win over the delete.
            initial.facts[atom.predicate].delete(&atom.arguments, 1);
        }
        Repair::Value { fluent, value } => initial.set_fluent(fluent.clone(), Some(Value::Number(*value))),
        _ => return false,
    }
    trials.passes_under(Ok(changed), plan)
}

/// Initial values with which a comparison would hold. One fluent absorbs the difference between the sides, on the
/// assumption that the plan only adds to it.
fn values(
    validator: &Validator<'_>,
    comparison: Comparison,
    left: &Operand,
    right: &Operand,
    into: &mut Vec<Repair>,
) {
    let mut offer = |fluent: &GroundApplication, value: Option<Number>| {
        let fits = |value: &Number| Number::from_f64(value.to_f64()) == Some(*value);
        if let Some(value) = value.filter(fits) {
            into.push(Repair::Value { fluent: fluent.clone(), value });
        }
    };
    let strict = matches!(comparison, Comparison::Less | Comparison::Greater);
    let sides = [(left, right, 1), (right, left, -1)];
    for (side, other, direction) in sides {
        let greater = match comparison {
            Comparison::Equal => 0,
            Comparison::Less | Comparison::LessEqual => -direction,
            Comparison::Greater | Comparison::GreaterEqual => direction,
        };
        let more = Number::integer(if strict { greater } else { 0 });
        let [(fluent, value)] = side.fluents.as_slice() else { continue };
        let Ok(other) = &other.value else { continue };
        let wanted = other.plus(more).ok();
        match (value, &side.value, validator.prepared.initial.fluent(fluent)) {
            (None, _, _) => offer(fluent, wanted),
            (Some(_), Ok(now), Some(Value::Number(first))) => {
                let lacking = wanted.and_then(|wanted| wanted.minus(*now).ok());
                offer(fluent, lacking.and_then(|lacking| first.plus(lacking).ok()));
            }
            _ => {}
        }
    }
}

/// Whether the plan passes if the condition at `span` is removed from the failing action.
fn without(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, at: Cause, span: Span) -> bool {
    let Some(index) = at.step().map(|step| step.0 as usize) else { return false };
    let mut domain = trials.validator.prepared.domain.clone();
    let head = match plan {
        PlanRef::Sequential(plan) => plan.steps.get(index).map(|step| StepHead::Action(step.action)),
        PlanRef::Temporal(plan) => plan.steps.get(index).map(|step| step.head),
        PlanRef::Hierarchical(plan) => {
            plan.steps.iter().nth(index).map(|step| StepHead::Action(step.step.action))
        }
    };
    let taken = match head {
        Some(StepHead::Action(action)) if domain.actions.get(action).is_some() => {
            take_away(&mut domain.actions[action].precondition, span)
        }
        Some(StepHead::DurativeAction(action)) if domain.durative_actions.get(action).is_some() => {
            let conditions = &mut domain.durative_actions[action].conditions;
            conditions.iter_mut().any(|timed| take_away(&mut timed.condition, span))
        }
        _ => false,
    };
    taken && trials.passes_under(Validator::new(&domain, trials.validator.prepared.problem), plan)
}

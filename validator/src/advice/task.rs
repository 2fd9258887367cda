//! Changes of the task: one more fact in the beginning, or one literal less in a precondition.

use super::{Repair, Trials, each_part, parts};
use crate::cause::Cause;
use crate::run::{PlanRef, Validator};
use crate::verdict::{Failure, Unsatisfied};
use pddl::model::{Condition, ConditionKind};
use pddl::{Span, StepHead};

pub(super) fn repair(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, failure: &Failure) -> Option<Repair> {
    // That the goal would hold if it held is no advice.
    if matches!(failure, Failure::Goal { .. }) {
        return None;
    }
    let mut missing = Vec::new();
    let mut spans = Vec::new();
    each_part(parts(failure), &mut |part| {
        if let Unsatisfied::Missing { atom, derived: false, .. } = part
            && !missing.contains(atom)
        {
            missing.push(atom.clone());
        }
    });
    // What stands deeper is not a part of the condition that could be taken away alone.
    spans.extend(parts(failure).iter().map(Unsatisfied::span));
    for atom in missing {
        let mut changed: Validator<'_> = trials.validator.clone();
        changed.initial.facts[atom.predicate].add(&atom.arguments, 0);
        if trials.passes_under(Ok(changed), plan) {
            return Some(Repair::Initially(atom));
        }
    }
    let Failure::Precondition { at, .. } = failure else { return None };
    for span in spans {
        if without(trials, plan, *at, span) {
            return Some(Repair::Without { span });
        }
    }
    None
}

/// Whether the plan passes when the failing action does not ask for what stands at `span`.
fn without(trials: &mut Trials<'_, '_>, plan: PlanRef<'_>, at: Cause, span: Span) -> bool {
    let Some(index) = at.step().map(|step| step.0 as usize) else { return false };
    let mut domain = trials.validator.domain.clone();
    let head = match plan {
        PlanRef::Sequential(plan) => plan.steps.get(index).map(|step| StepHead::Action(step.action)),
        PlanRef::Temporal(plan) => plan.steps.get(index).map(|step| step.head),
        PlanRef::Hierarchical(_) => None,
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
    taken && trials.passes_under(Validator::new(&domain, trials.validator.problem), plan)
}

/// Makes the conjunct at `span` true.
fn take_away(condition: &mut Condition, span: Span) -> bool {
    if condition.span == span {
        condition.kind = ConditionKind::And(Vec::new());
        return true;
    }
    match &mut condition.kind {
        ConditionKind::And(parts) => parts.iter_mut().any(|part| take_away(part, span)),
        // A negated atom has its own span.
        ConditionKind::Not(part) if part.span == span => {
            condition.kind = ConditionKind::And(Vec::new());
            true
        }
        _ => false,
    }
}

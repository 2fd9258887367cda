//! Applying a repair.
//!
//! Trials of plans with times, the text of a repaired plan, and the tests that compare both use the same code.

use super::change::Repair;
use crate::number::Number;
use crate::plan::{StepIndex, start};
use pddl::model::{
    Condition, ConditionKind, Domain, Fact, FluentFact, FluentValue, GroundApplication, Problem,
};
use pddl::{Decimal, Plan, Span, TemporalPlan};

impl Repair {
    /// Applies the repair to the domain, the problem or the plan. Does nothing if its target does not exist.
    pub fn apply(&self, domain: &mut Domain, problem: &mut Problem, plan: &mut Plan) {
        match self {
            Self::Initially(atom) => problem.init.push(Fact {
                predicate: atom.predicate,
                arguments: atom.arguments.to_vec(),
                span: Span::default(),
            }),
            Self::NotInitially(atom) => {
                problem
                    .init
                    .retain(|fact| fact.predicate != atom.predicate || fact.arguments != *atom.arguments);
            }
            Self::Value { fluent, value } => set_initially(problem, fluent, *value),
            Self::Without { span } => {
                let mut conditions = domain.actions.iter_mut().map(|action| &mut action.precondition);
                let timed = domain.durative_actions.iter_mut().flat_map(|action| &mut action.conditions);
                let _ = conditions.any(|condition| take_away(condition, *span))
                    || timed.map(|timed| &mut timed.condition).any(|condition| take_away(condition, *span));
            }
            _ => {
                if let Some(changed) = self.applied(plan) {
                    *plan = changed;
                }
            }
        }
    }

    /// The repaired plan; `None` if the repair does not change this plan.
    pub fn applied(&self, plan: &Plan) -> Option<Plan> {
        match plan {
            Plan::Sequential(plan) => {
                let mut plan = plan.clone();
                sequential(self, &mut plan.steps)?;
                plan.cost = None;
                Some(Plan::Sequential(plan))
            }
            Plan::Temporal(plan) => temporal(self, plan).map(Plan::Temporal),
            Plan::Hierarchical(_) => match self {
                Self::Decompose(otherwise) => Some(Plan::Hierarchical((**otherwise).clone())),
                _ => None,
            },
        }
    }
}

fn position(step: StepIndex, count: usize) -> Option<usize> {
    Some(step.0 as usize).filter(|&index| index < count)
}

fn sequential(repair: &Repair, steps: &mut Vec<pddl::PlanStep>) -> Option<()> {
    let count = steps.len();
    match repair {
        Repair::Drop(step) => {
            steps.remove(position(*step, count)?);
        }
        Repair::Insert { before, steps: new } => {
            let before = position(*before, count + 1)?;
            steps.splice(before..before, new.iter().cloned());
        }
        Repair::Move { step, before } => {
            let (step, before) = (position(*step, count)?, position(*before, count + 1)?);
            let moved = steps.remove(step);
            steps.insert(if before > step { before - 1 } else { before }, moved);
        }
        Repair::Swap { first, second } => steps.swap(position(*first, count)?, position(*second, count)?),
        Repair::Replace { step, arguments } => {
            steps[position(*step, count)?].arguments.clone_from(arguments);
        }
        _ => return None,
    }
    Some(())
}

/// The same for a plan with times, whose steps need not be in order.
pub(super) fn temporal(repair: &Repair, plan: &TemporalPlan) -> Option<TemporalPlan> {
    let mut plan = plan.clone();
    plan.cost = None;
    let count = plan.steps.len();
    match repair {
        Repair::Drop(step) => {
            plan.steps.remove(position(*step, count)?);
        }
        Repair::InsertAt { step, delay } => {
            let from = start(step);
            delay_from(&mut plan, from, *delay)?;
            let before = plan.steps.iter().position(|other| start(other) > from).unwrap_or(count);
            plan.steps.insert(before, step.clone());
        }
        Repair::Swap { first, second } => {
            let (first, second) = (position(*first, count)?, position(*second, count)?);
            let times = (plan.steps[first].start, plan.steps[second].start);
            (plan.steps[second].start, plan.steps[first].start) = times;
        }
        Repair::Replace { step, arguments } => {
            plan.steps[position(*step, count)?].arguments.clone_from(arguments);
        }
        Repair::Shift { step, start } => plan.steps[position(*step, count)?].start = *start,
        Repair::Delay { step, by } => {
            let from = start(&plan.steps[position(*step, count)?]);
            delay_from(&mut plan, from, *by)?;
        }
        Repair::Stretch { step, duration } => {
            plan.steps[position(*step, count)?].duration = Some(*duration);
        }
        _ => return None,
    }
    Some(plan)
}

fn delay_from(plan: &mut TemporalPlan, from: Number, by: Decimal) -> Option<()> {
    let by = Number::from_decimal(by);
    for step in plan.steps.iter_mut().filter(|step| start(step) >= from) {
        step.start = start(step).plus(by).ok()?.decimal()?;
    }
    Some(())
}

fn set_initially(problem: &mut Problem, fluent: &GroundApplication, value: Number) {
    let value = FluentValue::Number(value.to_f64());
    match problem.fluents.iter_mut().rfind(|fact| fact.application == *fluent) {
        Some(fact) => fact.value = value,
        None => {
            problem.fluents.push(FluentFact { application: fluent.clone(), value, span: Span::default() });
        }
    }
}

/// Makes the conjunct at `span` true.
pub(super) fn take_away(condition: &mut Condition, span: Span) -> bool {
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

//! Changes of a plan with times: a step is left out, starts at another time, or takes another time.

use super::{Repair, Trials, each_part, parts};
use crate::cause::Cause;
use crate::number::Number;
use crate::temporal::{end, start};
use crate::verdict::{Failure, StepIndex, Unsatisfied};
use pddl::{Decimal, TemporalPlan};

pub(super) fn repair(trials: &mut Trials<'_, '_>, plan: &TemporalPlan, failure: &Failure) -> Option<Repair> {
    let suspects = suspects(plan, failure);
    if let Failure::Duration { step, bound, .. } = failure
        && let Some(duration) = bound.value.as_ref().ok().and_then(|&value| decimal(value))
        && let Some(index) = suspects.first().copied()
    {
        let mut changed = plan.clone();
        changed.steps[index].duration = Some(duration);
        if trials.passes((&changed).into()) {
            return Some(Repair::Stretch { step: *step, duration });
        }
    }
    for index in suspects.iter().copied().chain(0..plan.steps.len()) {
        if trials.is_spent() {
            return None;
        }
        let mut changed = plan.clone();
        changed.steps.remove(index);
        if trials.passes((&changed).into()) {
            return Some(Repair::Drop(step_index(index)));
        }
    }
    for index in suspects {
        for time in times(trials, plan, index) {
            if trials.is_spent() {
                return None;
            }
            let Some(start) = decimal(time) else { continue };
            let mut changed = plan.clone();
            changed.steps[index].start = start;
            if trials.passes((&changed).into()) {
                return Some(Repair::Shift { step: step_index(index), start });
            }
        }
    }
    None
}

fn step_index(index: usize) -> StepIndex {
    StepIndex(u32::try_from(index).unwrap_or(u32::MAX))
}

/// The steps that fail or are to blame, without repetition.
fn suspects(plan: &TemporalPlan, failure: &Failure) -> Vec<usize> {
    let mut steps: Vec<StepIndex> = match failure {
        Failure::Precondition { at, .. } | Failure::Effect { at, .. } => at.step().into_iter().collect(),
        Failure::Step { step, .. } | Failure::Duration { step, .. } | Failure::Invariant { step, .. } => {
            vec![*step]
        }
        Failure::Interference { first, second, .. } => {
            [second, first].into_iter().filter_map(|cause| cause.step()).collect()
        }
        _ => Vec::new(),
    };
    each_part(parts(failure), &mut |part| {
        if let Unsatisfied::Missing { deleted_by: Some(by), .. }
        | Unsatisfied::Present { added_by: Some(by), .. } = part
        {
            steps.extend(Cause::step(*by));
        }
    });
    let mut found = Vec::new();
    for index in steps.into_iter().map(|step| step.0 as usize) {
        if index < plan.steps.len() && !found.contains(&index) {
            found.push(index);
        }
    }
    found
}

/// Times at which a step could start: just after and just before something else happens, or so that it ends
/// then; the nearest first.
fn times(trials: &Trials<'_, '_>, plan: &TemporalPlan, index: usize) -> Vec<Number> {
    let step = &plan.steps[index];
    let (now, until) = (start(step), end(step));
    let gap = trials.validator.precision.separation;
    let mut times = vec![Number::ZERO];
    let timed = trials.validator.problem.timed.iter().map(|timed| Number::from_decimal(timed.time));
    let others = plan.steps.iter().enumerate().filter(|&(other, _)| other != index);
    for at in others.flat_map(|(_, other)| [start(other), end(other)]).chain(timed) {
        let length = until.minus(now).unwrap_or(Number::ZERO);
        for at in [Ok(at), at.plus(gap), at.minus(gap)].into_iter().flatten() {
            times.push(at);
            times.extend(at.minus(length));
        }
    }
    times.retain(|&time| time >= Number::ZERO && time != now);
    times.sort();
    times.dedup();
    times.sort_by_key(|&time| {
        if time > now { time.minus(now) } else { now.minus(time) }.unwrap_or(Number::MAX)
    });
    times
}

fn decimal(number: Number) -> Option<Decimal> {
    number.to_string().parse().ok()
}

//! Changes of a plan with times: a step starts at another time, takes another time, is dropped or inserted.
//!
//! Every candidate is validated as a whole plan, because a step may interfere with any other step near it.

use super::apply::temporal;
use super::change::Repair;
use super::instances::{Look, conditions_at};
use super::timed_case::{Case, distance};
use super::timed_insert::insertions;
use super::trials::Trials;
use crate::number::Number;
use crate::plan::{StepIndex, end, start};
use crate::prepared::Prepared;
use crate::verdict::Failure;
use pddl::model::{ObjectId, TimeSpecifier};
use pddl::{StepHead, TemporalPlan};

/// The most candidates of one strategy.
const CANDIDATES: usize = 512;

/// To how many of the nearest starts and ends a step may be moved.
const NEAREST: usize = 2 * CANDIDATES;

/// A strategy that finds changes.
type Way = fn(&Prepared<'_>, &Case<'_>) -> Vec<Repair>;

/// The strategies, the most likely to succeed first.
const WAYS: [Way; 7] = [stretches, arguments, shifts, delays, drops, insertions, swaps];

pub(super) fn repairs(trials: &mut Trials<'_, '_>, plan: &TemporalPlan, failure: &Failure) -> Vec<Repair> {
    let validator = trials.validator;
    let (_, trace) = validator.trace(plan);
    let prepared = &validator.prepared;
    let case = Case::new(prepared, plan, failure, trace);
    let (plans, steps) = (trials.budget.plans, trials.budget.steps);
    let share = (plans.div_ceil(WAYS.len()), steps / WAYS.len());
    let mut left = (0, 0);
    let mut found: Vec<Repair> = Vec::new();
    for way in WAYS {
        if found.len() >= trials.budget.offers {
            break;
        }
        (trials.budget.plans, trials.budget.steps) = (share.0 + left.0, share.1 + left.1);
        for repair in way(prepared, &case).into_iter().take(CANDIDATES) {
            if trials.is_spent() {
                break;
            }
            let Some(changed) = temporal(&repair, plan) else { continue };
            if trials.passes((&changed).into()) {
                found.push(repair);
                break;
            }
        }
        left = (trials.budget.plans, trials.budget.steps);
    }
    found
}

/// A step has a wrong duration. Tries the bound of its duration first, and then ends near other happenings.
fn stretches(prepared: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    if let Failure::Duration { step, bound, .. } = case.failure
        && let Some(duration) = bound.value.as_ref().ok().and_then(|&value| value.decimal())
    {
        repairs.push(Repair::Stretch { step: *step, duration });
    }
    let durative = |index: &usize| matches!(case.plan.steps[*index].head, StepHead::DurativeAction(_));
    for index in case.suspects.iter().copied().filter(durative) {
        let began = start(&case.plan.steps[index]);
        for time in times(prepared, case.plan, index) {
            let duration = time.minus(began).ok().filter(|&d| d > Number::ZERO);
            if let Some(duration) = duration.and_then(Number::decimal) {
                repairs.push(Repair::Stretch { step: StepIndex::at(index), duration });
            }
        }
    }
    repairs
}

/// A step has a wrong argument: one with which its condition at the start holds where it starts.
fn arguments(prepared: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for index in case.likely() {
        let step = &case.plan.steps[index];
        let before = case.trace.happenings.partition_point(|happening| happening.time < start(step));
        let Some(state) = case.state_after(prepared, before) else { break };
        let look = Look { prepared, state: &state };
        for free in 0..step.arguments.len() {
            let mut fixed: Vec<Option<ObjectId>> = step.arguments.iter().copied().map(Some).collect();
            fixed[free] = None;
            let mut offer = |arguments: Vec<ObjectId>| {
                if arguments != step.arguments {
                    repairs.push(Repair::Replace { step: StepIndex::at(index), arguments });
                }
            };
            match step.head {
                StepHead::Action(id) => {
                    let Some(action) = prepared.domain.actions.get(id) else { continue };
                    look.applicable(&action.variables, &[&action.precondition], &fixed, &mut offer);
                }
                StepHead::DurativeAction(id) => {
                    let Some(action) = prepared.domain.durative_actions.get(id) else { continue };
                    let conditions = conditions_at(action, &TimeSpecifier::Start);
                    look.applicable(&action.variables, &conditions, &fixed, &mut offer);
                }
            }
        }
        if repairs.len() >= CANDIDATES {
            break;
        }
    }
    repairs
}

/// A step starts at another time.
fn shifts(prepared: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for index in case.likely() {
        let times = times(prepared, case.plan, index);
        let starts = times.into_iter().filter_map(Number::decimal);
        repairs.extend(starts.map(|start| Repair::Shift { step: StepIndex::at(index), start }));
        if repairs.len() >= CANDIDATES {
            break;
        }
    }
    repairs
}

/// A step and all after it start later.
fn delays(prepared: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for &index in &case.suspects {
        let now = start(&case.plan.steps[index]);
        let times = times(prepared, case.plan, index);
        let later = times.into_iter().filter_map(|time| time.minus(now).ok().filter(|&by| by > Number::ZERO));
        repairs.extend(
            later.filter_map(Number::decimal).map(|by| Repair::Delay { step: StepIndex::at(index), by }),
        );
    }
    repairs
}

/// A step is superfluous.
fn drops(_: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    case.likely().into_iter().map(|index| Repair::Drop(StepIndex::at(index))).collect()
}

/// Two steps have exchanged times.
fn swaps(_: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let likely = case.likely();
    let mut repairs = Vec::new();
    for (position, &one) in likely.iter().enumerate() {
        for &other in &likely[position + 1..] {
            let (first, second) = (StepIndex::at(one.min(other)), StepIndex::at(one.max(other)));
            repairs.push(Repair::Swap { first, second });
        }
        if repairs.len() >= CANDIDATES {
            break;
        }
    }
    repairs
}

/// Times at which a step could start, the nearest first: those at which it starts or ends just after or just before
/// another happening.
fn times(prepared: &Prepared<'_>, plan: &TemporalPlan, index: usize) -> Vec<Number> {
    let step = &plan.steps[index];
    let (now, until) = (start(step), end(step));
    let gap = prepared.precision.separation;
    let mut times = vec![Number::ZERO];
    let timed = prepared.problem.timed.iter().map(|timed| Number::from_decimal(timed.time));
    let others = plan.steps.iter().enumerate().filter(|&(other, _)| other != index);
    let mut points: Vec<Number> =
        others.flat_map(|(_, other)| [start(other), end(other)]).chain(timed).collect();
    if points.len() > NEAREST {
        points.select_nth_unstable_by_key(NEAREST, |&at| distance(at, now).min(distance(at, until)));
        points.truncate(NEAREST);
    }
    let length = until.minus(now).unwrap_or(Number::ZERO);
    for at in points {
        for at in [Ok(at), at.plus(gap), at.minus(gap)].into_iter().flatten() {
            times.push(at);
            times.extend(at.minus(length));
        }
    }
    times.retain(|&time| time >= Number::ZERO && time != now);
    times.sort();
    times.dedup();
    times.sort_by_key(|&time| distance(time, now));
    times
}

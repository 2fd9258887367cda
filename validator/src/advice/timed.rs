//! Changes of a plan with times: steps start at other times, take other times, are left out or put in.
//!
//! Every candidate is judged as a whole plan: what happens at one time may interfere with what happens anywhere near.

use super::apply::temporal;
use super::instances::{Look, conditions_at};
use super::timed_insert::insertions;
use super::wants::Wants;
use super::{Repair, Trials, decimal, each_part, parts, step_index};
use crate::cause::Cause;
use crate::number::Number;
use crate::run::Validator;
use crate::state::State;
use crate::temporal::{end, start};
use crate::trace::Trace;
use crate::verdict::{Failure, StepIndex, Unsatisfied};
use pddl::model::{ObjectId, TimeSpecifier};
use pddl::{StepHead, TemporalPlan};
use std::cell::Cell;
use std::ops::Range;

/// How many candidates one way of looking may have.
const CANDIDATES: usize = 512;

/// How many happenings are gone through to see earlier states, and facts copied for that.
const REPLAYED: usize = 100_000;

/// How many starts and ends, the nearest, a step may be moved to.
const NEAREST: usize = 2 * CANDIDATES;

/// A failing plan, and what is known of its failure.
pub(super) struct Case<'c> {
    pub(super) plan: &'c TemporalPlan,
    pub(super) failure: &'c Failure,
    pub(super) wants: Wants,
    /// What happened before it failed.
    pub(super) trace: Trace,
    /// When it fails, as far as that is one time.
    pub(super) time: Number,
    /// The steps that fail or are to blame.
    suspects: Vec<usize>,
    /// What may still be gone through.
    replays: Cell<usize>,
}

/// A way of looking for changes.
type Way = fn(&Validator<'_>, &Case<'_>) -> Vec<Repair>;

/// What is likely comes first.
const WAYS: [Way; 7] = [stretches, arguments, shifts, delays, drops, insertions, swaps];

pub(super) fn repairs(trials: &mut Trials<'_, '_>, plan: &TemporalPlan, failure: &Failure) -> Vec<Repair> {
    let validator = trials.validator;
    let (_, trace) = validator.trace(plan);
    let mut state = state_after(validator, &trace, trace.happenings.len());
    validator.derive(&mut state, u32::MAX);
    let wants = Wants::of(validator, &state, failure);
    let suspects = suspects(plan, failure);
    let time = time(plan, failure);
    let replays = Cell::new(REPLAYED);
    let case = Case { plan, failure, wants, trace, time, suspects, replays };
    let (plans, steps) = (trials.budget.plans, trials.budget.steps);
    let share = (plans.div_ceil(WAYS.len()), steps / WAYS.len());
    let mut left = (0, 0);
    let mut found: Vec<Repair> = Vec::new();
    for way in WAYS {
        if found.len() >= trials.budget.offers {
            break;
        }
        (trials.budget.plans, trials.budget.steps) = (share.0 + left.0, share.1 + left.1);
        for repair in way(validator, &case).into_iter().take(CANDIDATES) {
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

/// The state after so many happenings.
fn state_after(validator: &Validator<'_>, trace: &Trace, happenings: usize) -> State {
    let mut state = validator.initial.clone();
    state.effort = crate::effort::Effort::for_steps(0);
    advance(&mut state, trace, 0..happenings);
    state
}

/// Takes a state through some more happenings.
pub(super) fn advance(state: &mut State, trace: &Trace, happenings: Range<usize>) {
    let first = u32::try_from(happenings.start).unwrap_or(u32::MAX - 1) + 1;
    for (happening, moment) in trace.happenings[happenings].iter().zip(first..) {
        let diff = &happening.diff;
        for atom in &diff.added {
            state.facts[atom.predicate].add(&atom.arguments, moment);
        }
        for atom in &diff.deleted {
            state.facts[atom.predicate].delete(&atom.arguments, moment);
        }
        for change in diff.flowed.iter().chain(&diff.fluents) {
            state.set_fluent(change.fluent.clone(), change.after);
        }
    }
}

/// When it fails; at the end of the plan if that is not said.
fn time(plan: &TemporalPlan, failure: &Failure) -> Number {
    let last = || plan.steps.iter().map(end).max().unwrap_or(Number::ZERO);
    let of = |cause: Cause| {
        let step = plan.steps.get(cause.step()?.0 as usize)?;
        Some(if matches!(cause, Cause::End(_)) { end(step) } else { start(step) })
    };
    match failure {
        Failure::Precondition { at, .. } | Failure::Effect { at, .. } => of(*at),
        Failure::Step { step, .. } | Failure::Duration { step, .. } => of(Cause::Start(*step)),
        Failure::Interference { second, .. } => of(*second),
        Failure::Invariant { time, .. }
        | Failure::Change { time, .. }
        | Failure::EndlessEvents { time, .. } => Some(*time),
        Failure::Constraint { time, .. } => *time,
        Failure::Network { .. } | Failure::Goal { .. } => None,
    }
    .unwrap_or_else(last)
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

impl Case<'_> {
    /// The state after so many happenings, with what follows by axioms, as long as that may cost something.
    pub(super) fn state_after(&self, validator: &Validator<'_>, happenings: usize) -> Option<State> {
        let problem = validator.problem;
        let price = happenings + problem.init.len() + problem.fluents.len() + 1;
        self.replays.set(self.replays.get().checked_sub(price)?);
        let mut state = state_after(validator, &self.trace, happenings);
        validator.derive(&mut state, u32::MAX);
        Some(state)
    }

    /// All steps: the suspects, then the others, those near to the failure first.
    fn likely(&self) -> Vec<usize> {
        let mut others: Vec<usize> =
            (0..self.plan.steps.len()).filter(|index| !self.suspects.contains(index)).collect();
        others.sort_by_key(|&index| distance(start(&self.plan.steps[index]), self.time));
        self.suspects.iter().copied().chain(others).collect()
    }
}

fn distance(one: Number, other: Number) -> Number {
    if one > other { one.minus(other) } else { other.minus(one) }.unwrap_or(Number::MAX)
}

/// A step takes as long as its bound says; or, if that is not it, ends where something else does.
fn stretches(validator: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    if let Failure::Duration { step, bound, .. } = case.failure
        && let Some(duration) = bound.value.as_ref().ok().and_then(|&value| decimal(value))
    {
        repairs.push(Repair::Stretch { step: *step, duration });
    }
    let durative = |index: &usize| matches!(case.plan.steps[*index].head, StepHead::DurativeAction(_));
    for index in case.suspects.iter().copied().filter(durative) {
        let began = start(&case.plan.steps[index]);
        for time in times(validator, case.plan, index) {
            let duration = time.minus(began).ok().filter(|&d| d > Number::ZERO);
            if let Some(duration) = duration.and_then(decimal) {
                repairs.push(Repair::Stretch { step: step_index(index), duration });
            }
        }
    }
    repairs
}

/// A step has a wrong argument: one with which its condition at the start holds where it starts.
fn arguments(validator: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for index in case.likely() {
        let step = &case.plan.steps[index];
        let before = case.trace.happenings.partition_point(|happening| happening.time < start(step));
        let Some(state) = case.state_after(validator, before) else { break };
        let look = Look { validator, state: &state };
        for free in 0..step.arguments.len() {
            let mut fixed: Vec<Option<ObjectId>> = step.arguments.iter().copied().map(Some).collect();
            fixed[free] = None;
            let mut offer = |arguments: Vec<ObjectId>| {
                if arguments != step.arguments {
                    repairs.push(Repair::Replace { step: step_index(index), arguments });
                }
            };
            match step.head {
                StepHead::Action(id) => {
                    let Some(action) = validator.domain.actions.get(id) else { continue };
                    look.applicable(&action.variables, &[&action.precondition], &fixed, &mut offer);
                }
                StepHead::DurativeAction(id) => {
                    let Some(action) = validator.domain.durative_actions.get(id) else { continue };
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
fn shifts(validator: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for index in case.likely() {
        let times = times(validator, case.plan, index);
        let starts = times.into_iter().filter_map(decimal);
        repairs.extend(starts.map(|start| Repair::Shift { step: step_index(index), start }));
        if repairs.len() >= CANDIDATES {
            break;
        }
    }
    repairs
}

/// A step and all after it start later.
fn delays(validator: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    let mut repairs = Vec::new();
    for &index in &case.suspects {
        let now = start(&case.plan.steps[index]);
        let times = times(validator, case.plan, index);
        let later = times.into_iter().filter_map(|time| time.minus(now).ok().filter(|&by| by > Number::ZERO));
        repairs.extend(later.filter_map(decimal).map(|by| Repair::Delay { step: step_index(index), by }));
    }
    repairs
}

/// A step is too much.
fn drops(_: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    case.likely().into_iter().map(|index| Repair::Drop(step_index(index))).collect()
}

/// Two steps have each other's times.
fn swaps(_: &Validator<'_>, case: &Case<'_>) -> Vec<Repair> {
    let likely = case.likely();
    let mut repairs = Vec::new();
    for (position, &one) in likely.iter().enumerate() {
        for &other in &likely[position + 1..] {
            let (first, second) = (step_index(one.min(other)), step_index(one.max(other)));
            repairs.push(Repair::Swap { first, second });
        }
        if repairs.len() >= CANDIDATES {
            break;
        }
    }
    repairs
}

/// Times at which a step could start: just after and just before something else happens, or so that it ends
/// then; the nearest first.
fn times(validator: &Validator<'_>, plan: &TemporalPlan, index: usize) -> Vec<Number> {
    let step = &plan.steps[index];
    let (now, until) = (start(step), end(step));
    let gap = validator.precision.separation;
    let mut times = vec![Number::ZERO];
    let timed = validator.problem.timed.iter().map(|timed| Number::from_decimal(timed.time));
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

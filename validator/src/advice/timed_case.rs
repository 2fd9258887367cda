//! The analysis of a failure of a plan with times.

use super::wants::Wants;
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::{StepIndex, end, start};
use crate::prepared::Prepared;
use crate::state::State;
use crate::trace::Trace;
use crate::verdict::{Failure, Unsatisfied};
use crate::work::Work;
use pddl::TemporalPlan;
use std::cell::Cell;
use std::ops::Range;

/// The most happenings replayed, and facts copied, to restore earlier states.
const REPLAYED: usize = 100_000;

/// A failing plan with the analysis of its failure.
pub(super) struct Case<'c> {
    pub(super) plan: &'c TemporalPlan,
    pub(super) failure: &'c Failure,
    pub(super) wants: Wants,
    /// The happenings before the failure.
    pub(super) trace: Trace,
    /// The time of the failure, or the end of the plan if the failure has no single time.
    pub(super) time: Number,
    /// The steps that fail or cause the failure.
    pub(super) suspects: Vec<usize>,
    /// The rest of the budget for replays ([`REPLAYED`]).
    replays: Cell<usize>,
}

/// The state after the first `happenings` happenings.
fn state_after(prepared: &Prepared<'_>, trace: &Trace, happenings: usize) -> State {
    let mut state = prepared.initial.clone();
    state.work = Work::for_steps(0);
    advance(&mut state, trace, 0..happenings);
    state
}

/// Applies a range of happenings to a state.
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

impl<'c> Case<'c> {
    /// Analyses a failure. `trace` has the happenings before it.
    pub(super) fn new(
        prepared: &Prepared<'_>,
        plan: &'c TemporalPlan,
        failure: &'c Failure,
        trace: Trace,
    ) -> Self {
        let mut state = state_after(prepared, &trace, trace.happenings.len());
        prepared.derive(&mut state, u32::MAX);
        let wants = Wants::of(prepared, &state, failure);
        let (suspects, time) = (suspects(plan, failure), time(plan, failure));
        Self { plan, failure, wants, trace, time, suspects, replays: Cell::new(REPLAYED) }
    }

    /// The state after the first `happenings` happenings, with its derived atoms; `None` if the budget is exhausted.
    pub(super) fn state_after(&self, prepared: &Prepared<'_>, happenings: usize) -> Option<State> {
        let problem = prepared.problem;
        let price = happenings + problem.init.len() + problem.fluents.len() + 1;
        self.replays.set(self.replays.get().checked_sub(price)?);
        let mut state = state_after(prepared, &self.trace, happenings);
        prepared.derive(&mut state, u32::MAX);
        Some(state)
    }

    /// All steps: the suspects, then the others, the nearest to the failure first.
    pub(super) fn likely(&self) -> Vec<usize> {
        let mut others: Vec<usize> =
            (0..self.plan.steps.len()).filter(|index| !self.suspects.contains(index)).collect();
        others.sort_by_key(|&index| distance(start(&self.plan.steps[index]), self.time));
        self.suspects.iter().copied().chain(others).collect()
    }
}

/// The time of the failure, or the end of the plan if the failure has no single time.
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

/// The steps that fail or cause the failure, without repetition.
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
    Unsatisfied::each(failure.parts(), &mut |part| {
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

pub(super) fn distance(one: Number, other: Number) -> Number {
    if one > other { one.minus(other) } else { other.minus(one) }.unwrap_or(Number::MAX)
}

//! A missing step of a plan with times.
//!
//! It starts just after a happening at which its condition at the start holds, and it achieves a want. It uses an
//! existing gap, or one made by delaying everything after it.

use super::change::Repair;
use super::instances::{Look, conditions_at, each_match};
use super::timed_case::{Case, advance};
use crate::expression::bind_functions;
use crate::number::Number;
use crate::plan::start;
use crate::prepared::Prepared;
use crate::scene::{Binding, Clock};
use crate::state::State;
use pddl::model::{Comparison, DurativeActionId, ObjectId, TimeSpecifier};
use pddl::{Decimal, Span, StepHead, TemporalStep};

/// The number of happenings before the failure after which the step is tried.
const PLACES: usize = 24;

pub(super) fn insertions(prepared: &Prepared<'_>, case: &Case<'_>) -> Vec<Repair> {
    let happenings = &case.trace.happenings;
    let mut repairs = Vec::new();
    let mut delayed = Vec::new();
    let gap = prepared.precision.separation;
    let first = (happenings.len() + 1).saturating_sub(PLACES);
    let Some(mut state) = case.state_after(prepared, first) else { return Vec::new() };
    let mut places = Vec::new();
    for count in first..=happenings.len() {
        if count > first {
            advance(&mut state, &case.trace, count - 1..count);
            prepared.derive(&mut state, u32::MAX);
        }
        places.push((count, candidates(prepared, case, &state)));
    }
    for (count, candidates) in places.into_iter().rev() {
        let after = match count.checked_sub(1).and_then(|last| happenings.get(last)) {
            Some(last) => last.time.plus(gap).ok(),
            None => Some(Number::ZERO),
        };
        let Some(after) = after.and_then(Number::decimal) else { continue };
        for (head, arguments, duration) in candidates {
            let step = |start: Decimal| TemporalStep {
                start,
                head,
                arguments: arguments.clone(),
                duration: duration.and_then(Number::decimal),
                span: Span::default(),
                start_span: Span::default(),
                duration_span: None,
            };
            let length = duration.unwrap_or(Number::ZERO);
            repairs.push(Repair::InsertAt { step: step(after), delay: Decimal::ZERO });
            // As late as possible, if there is enough time.
            let latest =
                case.time.minus(length).and_then(|time| time.minus(gap)).ok().and_then(Number::decimal);
            if let Some(latest) = latest.filter(|time| !time.is_negative() && *time != after) {
                repairs.push(Repair::InsertAt { step: step(latest), delay: Decimal::ZERO });
            }
            let room = length.plus(gap).and_then(|room| room.plus(gap)).ok().and_then(Number::decimal);
            if let Some(delay) = room
                .filter(|_| case.plan.steps.iter().any(|other| start(other) >= Number::from_decimal(after)))
            {
                delayed.push(Repair::InsertAt { step: step(after), delay });
            }
        }
    }
    repairs.extend(delayed);
    repairs
}

type Candidate = (StepHead, Vec<ObjectId>, Option<Number>);

/// The steps that could start in a state and achieve a want.
fn candidates(prepared: &Prepared<'_>, case: &Case<'_>, state: &State) -> Vec<Candidate> {
    let look = Look { prepared, state };
    let mut found: Vec<Candidate> = Vec::new();
    let mut offer = |head, arguments: Vec<ObjectId>| {
        if !found.iter().any(|(other, with, _)| *other == head && *with == arguments) {
            found.push((head, arguments, None));
        }
    };
    for want in &case.wants.list {
        for (id, action) in prepared.domain.actions.enumerate() {
            each_match(prepared, &action.variables, &action.effect, want, &mut |fixed| {
                look.applicable(&action.variables, &[&action.precondition], &fixed, &mut |arguments| {
                    offer(StepHead::Action(id), arguments);
                });
            });
        }
        for (id, action) in prepared.domain.durative_actions.enumerate() {
            let conditions = conditions_at(action, &TimeSpecifier::Start);
            for timed in &action.effects {
                each_match(prepared, &action.variables, &timed.effect, want, &mut |fixed| {
                    look.applicable(&action.variables, &conditions, &fixed, &mut |arguments| {
                        offer(StepHead::DurativeAction(id), arguments);
                    });
                });
            }
        }
    }
    let with_durations = found.into_iter().flat_map(|(head, arguments, _)| match head {
        StepHead::Action(_) => vec![(head, arguments, None)],
        StepHead::DurativeAction(id) => {
            let lengths = durations(prepared, state, id, &arguments);
            lengths.into_iter().map(|length| (head, arguments.clone(), Some(length))).collect()
        }
    });
    with_durations.collect()
}

/// The least and the greatest duration that its bounds allow in this state.
fn durations(
    prepared: &Prepared<'_>,
    state: &State,
    action: DurativeActionId,
    arguments: &[ObjectId],
) -> Vec<Number> {
    let action = &prepared.domain.durative_actions[action];
    let scene = prepared.scene(state, &action.variables, Clock::steps(0));
    let mut binding = Binding::new(&action.variables, arguments);
    let mut least = Number::ZERO;
    let mut most = None;
    for constraint in &action.duration {
        let bound = bind_functions(scene, &constraint.functions, &mut binding)
            .and_then(|()| scene.number(&constraint.bound, &binding));
        let Ok(bound) = bound else { continue };
        match constraint.comparison {
            Comparison::Equal => return vec![bound],
            Comparison::Less | Comparison::LessEqual => most = Some(most.unwrap_or(bound).min(bound)),
            Comparison::Greater | Comparison::GreaterEqual => least = least.max(bound),
        }
    }
    if least == Number::ZERO && most.is_none() {
        least = Number::integer(1);
    }
    let mut lengths = vec![least];
    lengths.extend(most.filter(|&most| most > least));
    lengths
}

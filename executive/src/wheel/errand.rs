//! A task that is carried out outside a plan: the fallback, an escalation, or what bridges the time of a decision.
//!
//! Problem: a person must never be left alone because a call failed, and a fallback that goes on for ever must not keep
//! the mission from going on. Idea: an errand that fails is tried again, after waits that double, for ever. Meanwhile it
//! asks for a plan whenever a plan has become more likely, at intervals that grow. Which moment that is depends on the
//! trouble: *no plan*: the state changes, or a step that failed may be tried again; *stuck*: the state has stood still
//! for a while, for then what unsettled the mission may be over.

use super::backoff::{Backoff, after};
use super::effects::{tell, write};
use super::event::Effect;
use crate::Step;
use crate::narration::Narration;
use crate::outcome::{Stuck, Trouble};
use dsr::{Edit, Snapshot, Time};
use high_to_low::{Failure, Methods, Moment, Refinement, Status};
use planner::State;
use std::time::Duration;

/// Between two attempts of a task that fails.
const RETRIES: Backoff = Backoff::new(Duration::from_secs(2), Duration::from_secs(60));
/// Between two questions for a plan, when the state has changed.
const QUESTIONS: Backoff = Backoff::new(Duration::from_secs(1), Duration::from_secs(30));
/// Between two questions for a plan, when only time has passed.
const PATIENT: Backoff = Backoff::new(Duration::from_secs(2), Duration::from_secs(960));
/// How long the state must stand still before a mission that was stuck goes on.
const CALM: Backoff = Backoff::new(Duration::from_secs(30), Duration::from_secs(960));

pub(super) struct Errand {
    pub(super) task: Step,
    pub(super) purpose: Purpose,
    /// Whether it has been carried out.
    pub(super) done: bool,
    refinement: Option<Refinement>,
    failures: u32,
    /// When it goes on even if nothing changes: a deadline, or its next attempt.
    wake_at: Option<Time>,
    answer: Option<Answer>,
}

/// What an errand is for.
#[expect(clippy::large_enum_variant, reason = "a wheel has one of it")]
pub(super) enum Purpose {
    /// To do something about a trouble.
    Trouble(Trouble),
    /// To bridge the time until a decision.
    Meanwhile,
}

/// The last answer of Decision Support: no plan.
struct Answer {
    /// For this state; `None` if the world overtook the answer.
    state: Option<State>,
    at: Time,
    /// How many answers there have been.
    count: u32,
}

impl Errand {
    pub(super) fn new(task: Step, purpose: Purpose) -> Self {
        let (refinement, wake_at, answer) = (None, None, None);
        Self { task, purpose, done: false, refinement, failures: 0, wake_at, answer }
    }

    /// Carries it further.
    pub(super) fn carry(
        &mut self,
        methods: &Methods,
        snapshot: &Snapshot,
        moment: Moment,
        effects: &mut Vec<Effect>,
    ) {
        let waits = self.refinement.is_none() && self.wake_at.is_some_and(|at| moment.now < at);
        if self.done || waits {
            return;
        }
        let started = match self.refinement.take() {
            Some(refinement) => Ok(refinement),
            None => Refinement::new(methods, snapshot, &self.task.action, &self.task.arguments),
        };
        let mut refinement = match started {
            Ok(refinement) => refinement,
            Err(error) => return self.failed(Failure::from(error), moment.now, effects),
        };
        let step = refinement.step(methods, snapshot, moment);
        write(step.edits, effects);
        tell(step.events, effects);
        match step.status {
            Status::Running { wake_at } => {
                self.wake_at = wake_at;
                self.refinement = Some(refinement);
            }
            Status::Done => {
                self.wake_at = None;
                self.done = true;
                if matches!(self.purpose, Purpose::Trouble(Trouble::Stuck(_))) {
                    // What the mission wanted done about it is done: no answer from before counts.
                    self.answer = None;
                }
            }
            Status::Failed(failure) => self.failed(failure, moment.now, effects),
        }
    }

    fn failed(&mut self, why: Failure, now: Time, effects: &mut Vec<Effect>) {
        self.failures = self.failures.saturating_add(1);
        let wait = RETRIES.wait(self.failures);
        self.wake_at = Some(after(now, wait));
        let (task, seconds) = (self.task.clone(), wait.as_secs_f64());
        effects.push(Effect::Tell(Narration::Retried { task, why, seconds }));
    }

    /// Takes back its intentions that are not yet achieved.
    pub(super) fn withdraw(&mut self, snapshot: &Snapshot, effects: &mut Vec<Effect>) {
        if let Some(mut refinement) = self.refinement.take() {
            write(refinement.cancel(snapshot), effects);
        }
    }

    /// What takes back its intentions if PELEA is gone.
    pub(super) fn withdrawal(&self, methods: &Methods) -> Vec<Edit> {
        self.refinement.as_ref().map(|refinement| refinement.withdrawal(methods)).unwrap_or_default()
    }

    /// The goals have changed: no answer from before counts.
    pub(super) fn reconsider(&mut self) {
        self.answer = None;
    }

    /// There is no plan for `state`.
    pub(super) fn answered(&mut self, state: State, now: Time) {
        self.note(Some(state), now);
    }

    /// The world has overtaken an answer.
    pub(super) fn overtaken(&mut self, now: Time) {
        self.note(None, now);
    }

    fn note(&mut self, state: Option<State>, now: Time) {
        let count = self.answer.as_ref().map_or(0, |before| before.count).saturating_add(1);
        self.answer = Some(Answer { state, at: now, count });
    }

    /// Whether the last answer, that there is no plan, was for this state.
    pub(super) fn is_answered_for(&self, state: &State) -> bool {
        self.answer.as_ref().is_some_and(|answer| answer.state.as_ref() == Some(state))
    }

    /// When to ask for a plan. `since`: since when the state is as it is. `bar`: when a step that failed may be tried
    /// again. `level`: how often in a row the mission was stuck.
    pub(super) fn asks_at(&self, state: &State, since: Time, bar: Option<Time>, level: u32) -> Option<Time> {
        let answer = self.answer.as_ref();
        match &self.purpose {
            Purpose::Meanwhile => None,
            // It is over, or waits for no calm.
            Purpose::Trouble(Trouble::Stuck(stuck)) if !self.done && !matches!(stuck, Stuck::Attempts(_)) => {
                let calm = after(since, CALM.wait(level.max(1)));
                Some(answer.map_or(calm, |a| calm.max(after(a.at, QUESTIONS.wait(a.count)))))
            }
            Purpose::Trouble(_) => match answer {
                None => Some(since),
                Some(a) if a.state.as_ref() != Some(state) => {
                    Some(since.max(after(a.at, QUESTIONS.wait(a.count - 1))))
                }
                Some(a) => bar.map(|bar| bar.max(after(a.at, PATIENT.wait(a.count)))),
            },
        }
    }

    /// When it goes on even if nothing changes.
    pub(super) fn wake_at(&self) -> Option<Time> {
        self.wake_at
    }
}

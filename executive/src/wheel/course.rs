//! A plan under way: its current step, and that step's refinement.

use super::effects::{tell, write};
use super::event::Effect;
use crate::Model;
use crate::monitoring::Monitor;
use crate::narration::Narration;
use dsr::{Edit, Snapshot, Time};
use high_to_low::{Methods, Moment, Refinement, Status};
use planner::{Goal, OperatorId, State, Task};

/// A plan, its current step, and that step's refinement.
pub(super) struct Course {
    pub(super) monitor: Monitor,
    /// The current step; the plan's length when all are done.
    pub(super) current: usize,
    refinement: Option<Refinement>,
    /// The next deadline of the current step.
    wake_at: Option<Time>,
}

/// What Monitoring finds about the current step.
pub(super) enum Progress {
    /// The suffix from the current step is the furthest that reaches the goal.
    Stays,
    /// A later suffix does.
    Moves {
        /// Its first step.
        to: usize,
    },
    /// No suffix from the current step on does.
    Deviates,
}

impl Course {
    pub(super) fn new(model: &Model, plan: Vec<OperatorId>, goal: Goal, state: &State) -> Self {
        Self {
            monitor: Monitor::new(model.task(), plan, goal, state),
            current: 0,
            refinement: None,
            wake_at: None,
        }
    }

    /// The same plan with what has been begun of the current step of another.
    pub(super) fn carrying(mut self, other: Self) -> Self {
        (self.refinement, self.wake_at) = (other.refinement, other.wake_at);
        self
    }

    /// The steps from the current one on.
    pub(super) fn left(&self) -> &[OperatorId] {
        &self.monitor.plan()[self.current.min(self.monitor.plan().len())..]
    }

    /// When the current step goes on even if nothing changes.
    pub(super) fn wake_at(&self) -> Option<Time> {
        self.wake_at
    }

    /// Whether the current step has been started.
    pub(super) fn is_under_way(&self) -> bool {
        self.refinement.is_some()
    }

    pub(super) fn progress(&self, task: &Task) -> Progress {
        match self.monitor.furthest(task) {
            Some(to) if to == self.current => Progress::Stays,
            Some(to) if to > self.current => Progress::Moves { to },
            // An earlier suffix may reach the goal, by steps that were meant for another situation; Decision Support
            // decides whether that is the best way from here.
            _ => Progress::Deviates,
        }
    }

    /// Leaves the current step for a later one.
    pub(super) fn move_to(
        &mut self,
        to: usize,
        model: &Model,
        snapshot: &Snapshot,
        effects: &mut Vec<Effect>,
    ) {
        let step = |i: usize| model.step(self.monitor.plan()[i]);
        let (index, first) = (self.current, step(self.current));
        effects.push(Effect::Tell(Narration::Achieved { index, step: first }));
        let skipped: Vec<_> = (self.current + 1..to).map(step).collect();
        if !skipped.is_empty() {
            effects.push(Effect::Tell(Narration::Skipped { steps: skipped }));
        }
        self.withdraw(snapshot, effects);
        self.current = to;
    }

    /// Carries the current step further, and starts it first if it has not been started.
    pub(super) fn refine(
        &mut self,
        model: &Model,
        methods: &Methods,
        snapshot: &Snapshot,
        moment: Moment,
        effects: &mut Vec<Effect>,
    ) -> Status {
        let mut refinement = match self.refinement.take() {
            Some(refinement) => refinement,
            None => {
                let step = model.step(self.monitor.plan()[self.current]);
                effects.push(Effect::Tell(Narration::Started { index: self.current, step: step.clone() }));
                match Refinement::new(methods, snapshot, &step.action, &step.arguments) {
                    Ok(refinement) => refinement,
                    Err(error) => return Status::Failed(error.into()),
                }
            }
        };
        let step = refinement.step(methods, snapshot, moment);
        write(step.edits, effects);
        tell(step.events, effects);
        self.refinement = Some(refinement);
        self.wake_at = match step.status {
            Status::Running { wake_at } => wake_at,
            Status::Done | Status::Failed(_) => None,
        };
        step.status
    }

    /// Takes back the intentions of the current step that are not yet achieved.
    pub(super) fn withdraw(&mut self, snapshot: &Snapshot, effects: &mut Vec<Effect>) {
        self.wake_at = None;
        if let Some(mut refinement) = self.refinement.take() {
            write(refinement.cancel(snapshot), effects);
        }
    }

    /// What takes back the intentions of the current step if PELEA is gone.
    pub(super) fn withdrawal(&self, methods: &Methods) -> Vec<Edit> {
        self.refinement.as_ref().map(|refinement| refinement.withdrawal(methods)).unwrap_or_default()
    }

    /// Goes on with the current step of `old` if this plan starts with it; otherwise withdraws it.
    pub(super) fn take_over(
        &mut self,
        mut old: Self,
        snapshot: &Snapshot,
        effects: &mut Vec<Effect>,
    ) -> bool {
        let running = old.monitor.plan().get(old.current);
        if running.is_some() && running == self.monitor.plan().first() {
            (self.refinement, self.wake_at) = (old.refinement, old.wake_at);
            self.refinement.is_some()
        } else {
            old.withdraw(snapshot, effects);
            false
        }
    }
}

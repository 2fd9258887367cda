//! A plan being carried out: Monitoring, then HighToLow.

use super::course::{Carried, Course, Progress};
use super::effects::is_write;
use super::event::Effect;
use super::goals::is_surprised;
use super::state::{Hand, Rest, Wheel};
use crate::goals::Review;
use crate::narration::Narration;
use crate::outcome::{StepFailure, Stuck};
use high_to_low::Status;

impl Wheel {
    /// Finds what is done of the plan, and carries further what may be carried out now.
    pub(super) fn act(&mut self, mut course: Course, effects: &mut Vec<Effect>) {
        if self.agenda.review(&self.agenda.candidates()) == Review::Now && course.is_under_way() {
            self.hand = Hand::Plan(course);
            return self.ask(Vec::new(), effects);
        }
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        match course.progress(self.model.task()) {
            Progress::Stays => {}
            Progress::Moves(steps) => {
                let operators: Vec<_> = steps.iter().map(|&step| course.operator(step)).collect();
                if is_surprised(&mut self.expected, &self.model, sight, &operators) {
                    self.agenda.doubt();
                }
                let left = course.leave(&steps, &self.model, &sight.state, &sight.snapshot, effects);
                for achieved in left {
                    self.failures.forget(&self.model.step(achieved));
                    if self.patience.achieved(achieved) {
                        self.failures.progressed();
                    }
                }
            }
            Progress::Deviates => {
                let mut deviation = course.deviation(&self.model, &sight.state);
                sight.name_tokens(&mut deviation);
                effects.push(Effect::Tell(Narration::Deviated(deviation)));
                self.hand = Hand::Plan(course);
                return self.ask(Vec::new(), effects);
            }
        }
        if effects.iter().any(is_write) {
            self.hand = Hand::Plan(course);
            return;
        }
        if course.left().is_empty() {
            return self.plan_ended(effects);
        }
        if self.is_review_due(&course) {
            self.hand = Hand::Plan(course);
            return self.ask(Vec::new(), effects);
        }
        let front = course.front();
        let changes = self.agenda.turn_to(front[0]);
        self.tell_goals(changes, effects);
        for step in front {
            let operator = course.operator(step);
            let starts = !course.is_running(step);
            if starts && let Err(times) = self.patience.may_start(operator) {
                self.hand = Hand::Plan(course);
                let step = self.model.step(operator);
                return self.escalate(Stuck::Restarts { step, times }, effects);
            }
            let seen = (&sight.state, &sight.snapshot);
            let why = match course.refine(step, &self.model, &self.methods, seen, self.moment, effects) {
                Carried::Waits => continue,
                Carried::Is(Status::Running { .. }) => None,
                Carried::Late(seconds) => Some(StepFailure::Late(seconds)),
                // Its effects would have been left above: it is carried out, and its effects are not sensed.
                Carried::Is(Status::Done) => Some(StepFailure::NotSensed),
                Carried::Is(Status::Failed(failure)) => Some(StepFailure::Refinement(failure)),
            };
            if starts {
                // It may start: that was asked above.
                let _ = self.patience.starts(operator);
            }
            if let Some(why) = why {
                return self.failed(course, step, why, effects);
            }
        }
        self.hand = Hand::Plan(course);
        self.note_starts();
    }

    /// Notices which actions are under way now, and lets the state say so.
    pub(super) fn note_starts(&mut self) {
        let Some(sight) = &mut self.sight else { return };
        let mut under_way = Vec::new();
        let mut redraws = false;
        if let Hand::Plan(course) = &mut self.hand {
            redraws = course.notice_starts(&self.model, &sight.state);
            under_way = course.under_way(&self.model);
        }
        if self.under_way.is_empty() && under_way.is_empty() {
            return;
        }
        let ended = self.under_way.iter().filter(|fact| !under_way.contains(fact));
        let changes = ended.map(|&fact| (fact, false)).chain(under_way.iter().map(|&fact| (fact, true)));
        let changed = self.model.task().change(&mut sight.state, changes.collect::<Vec<_>>());
        self.under_way = under_way;
        if let Hand::Plan(course) = &mut self.hand {
            if redraws {
                course.redraw(&self.model, &sight.state);
            } else if changed {
                course.observe(self.model.task(), &sight.state);
            }
        }
    }

    /// Every step is done: what else is wanted needs another plan.
    fn plan_ended(&mut self, effects: &mut Vec<Effect>) {
        self.agenda.serve_none();
        self.ask(Vec::new(), effects);
    }

    /// A step failed: bar it for a while, and ask for another plan.
    pub(super) fn failed(
        &mut self,
        mut course: Course,
        failed: usize,
        why: StepFailure,
        effects: &mut Vec<Effect>,
    ) {
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        let step = self.model.step(course.operator(failed));
        effects.push(Effect::Tell(Narration::Failed { step: step.clone(), why }));
        self.failures.add(step, &sight.state, self.moment.now);
        let left = course.left();
        if course.stop(failed, &sight.snapshot, effects) {
            // The others go on while another plan is made.
            self.hand = Hand::Plan(course);
        }
        self.note_starts();
        self.ask(left, effects);
    }

    /// Waits until a step that failed may be tried again, or anything changes.
    pub(super) fn rest(&mut self, rest: Rest, effects: &mut Vec<Effect>) {
        let sight = self.sight.as_ref().expect("a rest follows a decision about what was seen");
        if sight.state != rest.from || self.moment.now >= rest.until {
            self.ask(Vec::new(), effects);
        } else {
            self.hand = Hand::Rest(rest);
        }
    }
}

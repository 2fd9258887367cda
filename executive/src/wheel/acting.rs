//! A plan being carried out: Monitoring, then HighToLow.

use super::course::{Course, Progress};
use super::effects::is_write;
use super::event::Effect;
use super::goals::is_surprised;
use super::state::{Hand, Rest, Wheel};
use crate::goals::Review;
use crate::narration::Narration;
use crate::outcome::{StepFailure, Stuck};
use high_to_low::Status;

impl Wheel {
    /// Finds the current step of the plan, and carries it further.
    pub(super) fn act(&mut self, mut course: Course, effects: &mut Vec<Effect>) {
        if self.agenda.review(&self.agenda.candidates()) == Review::Now && course.is_under_way() {
            self.hand = Hand::Plan(course);
            return self.ask(Vec::new(), effects);
        }
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        match course.progress(self.model.task()) {
            Progress::Stays => {}
            Progress::Moves { to } => {
                let achieved = course.monitor.plan()[course.current];
                let steps = &course.monitor.plan()[course.current..to];
                if is_surprised(&mut self.expected, &self.model, sight, steps) {
                    self.agenda.doubt();
                }
                self.failures.forget(&self.model.step(achieved));
                course.move_to(to, &self.model, &sight.snapshot, effects);
                if self.patience.achieved(achieved) {
                    self.failures.progressed();
                }
            }
            Progress::Deviates => {
                let mut deviation = course.monitor.deviation(&self.model, &sight.state, course.current);
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
        let changes = self.agenda.turn_to(course.current);
        self.tell_goals(changes, effects);
        let current = course.monitor.plan()[course.current];
        if !course.is_under_way()
            && let Err(times) = self.patience.starts(current)
        {
            self.hand = Hand::Plan(course);
            let step = self.model.step(current);
            return self.escalate(Stuck::Restarts { step, times }, effects);
        }
        match course.refine(&self.model, &self.methods, &sight.snapshot, self.moment, effects) {
            Status::Running { .. } => self.hand = Hand::Plan(course),
            // Its effects would have moved the course on above: it is carried out, and its effects are not sensed.
            Status::Done => self.failed(course, StepFailure::NotSensed, effects),
            Status::Failed(failure) => self.failed(course, StepFailure::Refinement(failure), effects),
        }
    }

    /// Every step is done: what else is wanted needs another plan.
    fn plan_ended(&mut self, effects: &mut Vec<Effect>) {
        self.agenda.serve_none();
        self.ask(Vec::new(), effects);
    }

    /// The current step failed: bar it for a while, and ask for another plan.
    pub(super) fn failed(&mut self, mut course: Course, why: StepFailure, effects: &mut Vec<Effect>) {
        let sight = self.sight.as_ref().expect("a plan is made from what was seen");
        let step = self.model.step(course.monitor.plan()[course.current]);
        effects.push(Effect::Tell(Narration::Failed { step: step.clone(), why }));
        self.failures.add(step, &sight.state, self.moment.now);
        course.withdraw(&sight.snapshot, effects);
        self.ask(course.left().to_vec(), effects);
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

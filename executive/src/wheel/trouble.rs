//! The mission does not go on: the fallback, the escalation, and the ways out of both.

use super::effects::is_write;
use super::errand::{Errand, Purpose};
use super::event::Effect;
use super::state::{Hand, Wheel};
use crate::narration::Narration;
use crate::outcome::{Ending, NoPlan, Stuck, Trouble};
use dsr::Time;

impl Wheel {
    /// There is no plan: the fallback starts, or goes on.
    pub(super) fn fall_back(&mut self, why: NoPlan, effects: &mut Vec<Effect>) {
        if matches!(&self.hand, Hand::Errand(e) if matches!(e.purpose, Purpose::Trouble(_))) {
            return self.no_plan_during_errand(why, effects);
        }
        self.stop(effects);
        effects.push(Effect::Tell(Narration::FellBack { why: why.clone() }));
        self.postpone_all(&why, effects);
        let mut errand = Errand::new(self.policy.fallback.clone(), Purpose::Trouble(Trouble::NoPlan(why)));
        self.note_answer(&mut errand);
        self.start(errand, effects);
    }

    /// The mission does not get on: its escalation starts.
    pub(super) fn escalate(&mut self, why: Stuck, effects: &mut Vec<Effect>) {
        self.moot(effects);
        self.patience.escalated();
        let over = self.patience.is_over();
        let task = if over { &self.policy.fallback } else { self.policy.escalation() }.clone();
        effects.push(Effect::Tell(Narration::Escalated { why: why.clone(), task: task.clone() }));
        let attempts = matches!(why, Stuck::Attempts(_));
        let purpose = Purpose::Trouble(Trouble::Stuck(why));
        match self.take_hand() {
            // The same call goes on.
            Hand::Errand(mut errand) if errand.task == task && !errand.done => {
                errand.purpose = purpose;
                self.start(*errand, effects);
            }
            other => {
                self.hand = other;
                self.stop(effects);
                let mut errand = Errand::new(task, purpose);
                if attempts {
                    self.note_answer(&mut errand);
                }
                self.start(errand, effects);
            }
        }
    }

    /// Decision Support gave no plan for the present state, except perhaps one with steps that are barred.
    pub(super) fn no_plan_during_errand(&mut self, why: NoPlan, effects: &mut Vec<Effect>) {
        let Hand::Errand(mut errand) = self.take_hand() else { return };
        self.note_answer(&mut errand);
        if errand.task == self.policy.fallback {
            errand.purpose = Purpose::Trouble(Trouble::NoPlan(why));
        } else if errand.done {
            // The mission's own escalation has been carried out, and that was not enough.
            return self.fall_back(why, effects);
        }
        self.carry(errand, effects);
    }

    fn note_answer(&self, errand: &mut Errand) {
        // While a question is open there is no answer.
        if let (Some(sight), None) = (&self.sight, &self.inquiry) {
            errand.answered(sight.state.clone(), self.moment.now);
        }
    }

    /// Starts an errand, after the withdrawal of what was carried out before.
    fn start(&mut self, errand: Errand, effects: &mut Vec<Effect>) {
        if effects.iter().any(is_write) {
            self.hand = Hand::Errand(Box::new(errand));
        } else {
            self.carry(Box::new(errand), effects);
        }
    }

    /// Carries an errand further, and asks for a plan when one has become more likely.
    pub(super) fn carry(&mut self, mut errand: Box<Errand>, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let was_done = errand.done;
        errand.carry(&self.methods, &sight.snapshot, self.moment, effects);
        if errand.done && !was_done && matches!(errand.purpose, Purpose::Trouble(Trouble::Stuck(_))) {
            // What the mission wanted done about it is done: everything may be tried again.
            self.failures.forget_all();
        }
        let ends = errand.done && self.inquiry.is_none();
        let why = match &errand.purpose {
            Purpose::Trouble(Trouble::NoPlan(why)) if errand.is_answered_for(&sight.state) => {
                Some(why.clone())
            }
            Purpose::Trouble(Trouble::Stuck(why)) if self.patience.is_over() => {
                Some(NoPlan::Stuck(why.clone()))
            }
            Purpose::Trouble(_) | Purpose::Meanwhile => None,
        };
        self.hand = Hand::Errand(errand);
        if let Some(why) = why.filter(|_| ends) {
            return self.handed_over(why, effects);
        }
        if self.next_question().is_some_and(|at| self.moment.now >= at) {
            self.ask(Vec::new(), effects);
        }
    }

    /// A human has come, and there is no plan: the mission ends, or goes on with what may be wanted later.
    fn handed_over(&mut self, why: NoPlan, effects: &mut Vec<Effect>) {
        if self.agenda.has_lasting() {
            return self.end(Ending::WithHuman { why }, effects);
        }
        let changes = self.agenda.give_up_all(&why);
        self.tell_goals(changes, effects);
        self.stop(effects);
    }

    /// When an errand asks for a plan, in the wheel's time.
    pub(super) fn next_question(&self) -> Option<Time> {
        let (Hand::Errand(errand), None, Some(sight)) = (&self.hand, &self.inquiry, &self.sight) else {
            return None;
        };
        if self.agenda.candidates().is_empty() {
            return None;
        }
        let bar = self.failures.next_end(&sight.state, self.moment.now);
        errand.asks_at(&sight.state, sight.since, bar, self.patience.level())
    }
}

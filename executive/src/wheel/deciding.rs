//! Questions to Decision Support: when they are asked, what happens meanwhile, what becomes of the answer.
//!
//! The wheel never waits for an answer. A plan that does not fit the present any more is asked for again; a question that
//! the world has answered itself is cancelled; a decision that takes too long starts the fallback, which a later plan
//! displaces.

use super::backoff::after;
use super::course::{Course, Progress};
use super::errand::{Errand, Purpose};
use super::event::Effect;
use super::state::{Hand, Inquiry, Rest, Wheel};
use crate::decision_support::{Decision, Repair, Request, RequestId};
use crate::goal::GoalId;
use crate::goals::Stage;
use crate::narration::Narration;
use crate::outcome::{Ending, NoPlan, Stuck, Trouble};
use dsr::Time;
use planner::OperatorId;
use std::sync::Arc;

impl Wheel {
    /// Asks for a plan from here. `stopped`: what is left of a plan whose current step has ended.
    pub(super) fn ask(&mut self, stopped: Vec<OperatorId>, effects: &mut Vec<Effect>) {
        self.moot(effects);
        let goals = self.agenda.candidates();
        let Some(sight) = self.sight.as_ref().filter(|_| !goals.is_empty()) else { return };
        let id = RequestId(self.next_request);
        self.next_request += 1;
        let (left, running) = self.hand.left();
        effects.push(Effect::Plan(Request {
            id,
            state: sight.state.clone(),
            goals: goals.clone(),
            broken: if left.is_empty() { stopped.clone() } else { left },
            served: self.agenda.unachieved(),
            running,
            barred: self.failures.barred(&sight.state, self.moment.now),
            expansions: self.policy.expansions,
            arrived: self.arrived(),
        }));
        self.considered_objects.clone_from(&self.arrived);
        let (from, asked) = (sight.state.clone(), self.moment.now);
        let fits = |course: &Course| !matches!(course.progress(self.model.task()), Progress::Deviates);
        let review = matches!(&self.hand, Hand::Plan(course) if fits(course));
        self.inquiry = Some(Inquiry { id, from, asked, stopped, late: false, review });
        self.agenda.considered(goals);
    }

    /// An answer to the open question, if any, is no longer needed.
    pub(super) fn moot(&mut self, effects: &mut Vec<Effect>) {
        effects.extend(self.inquiry.take().map(|inquiry| Effect::Cancel(inquiry.id)));
    }

    /// What an open question means for what is being carried out.
    pub(super) fn wait_for_decision(&mut self, effects: &mut Vec<Effect>) {
        let (Some(inquiry), Some(sight)) = (&mut self.inquiry, &self.sight) else { return };
        let now = self.moment.now;
        if let Hand::Plan(course) = &self.hand
            && !matches!(course.progress(self.model.task()), Progress::Deviates)
        {
            return match inquiry.review {
                // The plan rests only as long as a decision may take.
                true if now < after(inquiry.asked, self.policy.deciding) => {}
                true => self.moot(effects),
                false => self.goes_on(effects),
            };
        }
        if inquiry.late {
            // Too old to wait for, and for another state.
            if inquiry.from != sight.state {
                let stopped = std::mem::take(&mut inquiry.stopped);
                self.ask_again(stopped, effects);
            }
        } else if now >= after(inquiry.asked, self.policy.deciding) {
            inquiry.late = true;
            if !matches!(&self.hand, Hand::Errand(e) if matches!(e.purpose, Purpose::Trouble(_))) {
                self.fall_back(NoPlan::Late(self.policy.deciding.as_secs_f64()), effects);
            }
        } else if now >= after(inquiry.asked, self.policy.meanwhile_after)
            && matches!(self.hand, Hand::Empty | Hand::Plan(_))
            && let Some(task) = self.policy.meanwhile.clone()
        {
            effects.push(Effect::Tell(Narration::Meanwhile { task: task.clone() }));
            if let Hand::Plan(mut course) = std::mem::replace(&mut self.hand, Hand::Empty) {
                course.withdraw(&sight.snapshot, effects);
            }
            self.hand = Hand::Errand(Box::new(Errand::new(task, Purpose::Meanwhile)));
        }
    }

    /// The plan whose deviation was asked about fits again.
    fn goes_on(&mut self, effects: &mut Vec<Effect>) {
        self.moot(effects);
        effects.push(Effect::Tell(Narration::FitsAgain));
        let Hand::Plan(course) = &self.hand else { return };
        // Whoever breaks a step off and lets it go on makes it start again, as far as a listener can tell.
        for step in course.running().into_iter().map(|step| course.operator(step)) {
            if let Err(times) = self.patience.starts(step) {
                let step = self.model.step(step);
                return self.escalate(Stuck::Restarts { step, times }, effects);
            }
        }
    }

    /// When an open question comes to matter, in the wheel's time.
    pub(super) fn decision_due(&self) -> Option<Time> {
        let inquiry = self.inquiry.as_ref().filter(|inquiry| !inquiry.late)?;
        let late = after(inquiry.asked, self.policy.deciding);
        let may_bridge = self.policy.meanwhile.is_some()
            && !inquiry.review
            && matches!(self.hand, Hand::Empty | Hand::Plan(_));
        let bridge = may_bridge.then(|| after(inquiry.asked, self.policy.meanwhile_after));
        Some(bridge.map_or(late, |bridge| bridge.min(late)))
    }

    /// Compares an answer with the present.
    pub(super) fn decided(&mut self, decision: Decision, inquiry: Inquiry, effects: &mut Vec<Effect>) {
        if let Decision::Plan { model: Some(model), .. } = &decision {
            self.switch(Arc::clone(model), effects);
        }
        let Some(sight) = &self.sight else { return };
        let moved_on = sight.state != inquiry.from;
        let other_goals = self.agenda.candidates() != self.agenda.last_considered();
        match decision {
            Decision::Plan { operators, stages, postponed, forgone, .. }
                if inquiry.review && self.is_confirmed(&operators, &stages) =>
            {
                let changes = self.agenda.confirm(&postponed, &forgone);
                self.tell_goals(changes, effects);
                self.advance(effects);
            }
            Decision::Plan { operators, expanded, repair, stages, postponed, forgone, .. } => {
                let without = self.agenda.forgo(&forgone);
                let served: Vec<_> = stages.iter().flat_map(|stage| stage.goals.iter().copied()).collect();
                let goal = self.model.goal(&served);
                let course = Course::new(&self.model, operators, goal, &sight.state);
                let fits = !matches!(course.progress(self.model.task()), Progress::Deviates);
                match fits && self.agenda.still_want(&served) {
                    true => {
                        self.adopt(course, (expanded, repair), (stages, &postponed), effects);
                        self.tell_goals(without, effects);
                    }
                    false => self.ask_again(inquiry.stopped, effects),
                }
            }
            // A decision for another state, or for other goals, does not hold for this one.
            Decision::NoPlan(_) | Decision::Barred(_) if moved_on || other_goals => {
                self.ask_again(inquiry.stopped, effects);
            }
            // Nobody is called because of something that would have been nice.
            Decision::NoPlan(why) | Decision::Barred(why) if self.agenda.is_idle() => {
                let changes = self.agenda.give_up_all(&why);
                self.tell_goals(changes, effects);
                self.advance(effects);
            }
            Decision::NoPlan(why) => self.fall_back(why, effects),
            Decision::Barred(why) => self.barred(why, effects),
        }
    }

    /// Acts on a plan.
    fn adopt(
        &mut self,
        mut course: Course,
        (expanded, repair): (u64, Option<Repair>),
        (stages, postponed): (Vec<Stage>, &[(GoalId, NoPlan)]),
        effects: &mut Vec<Effect>,
    ) {
        let Some(sight) = &self.sight else { return };
        if let Err(stuck) = self.patience.adopts(self.model.task(), course.plan()) {
            return self.escalate(stuck, effects);
        }
        // Asked before anything is withdrawn: a call that goes on as an escalation stands.
        let running = self.hand.left().1;
        for first in course.front().into_iter().map(|step| course.operator(step)) {
            if !running.contains(&first)
                && let Err(times) = self.patience.may_start(first)
            {
                let step = self.model.step(first);
                return self.escalate(Stuck::Restarts { step, times }, effects);
            }
        }
        let survives = match std::mem::replace(&mut self.hand, Hand::Empty) {
            Hand::Plan(old) => course.take_over(old, &self.model, &sight.snapshot, effects),
            Hand::Errand(mut errand) => {
                errand.withdraw(&sight.snapshot, effects);
                if matches!(errand.purpose, Purpose::Trouble(_)) {
                    effects.push(Effect::Tell(Narration::Displaced { task: errand.task }));
                }
                false
            }
            Hand::Empty | Hand::Rest(_) => false,
        };
        self.plans += 1;
        let plan = course.plan().iter().map(|&o| self.model.step(o)).collect();
        let (count, goals) = (self.plans, self.names_of(&stages));
        effects.push(Effect::Tell(Narration::Planned { plan, expanded, survives, repair, count, goals }));
        self.expected = self.sight.as_ref().filter(|_| !postponed.is_empty()).map(|s| s.state.clone());
        let changes = self.agenda.serve(stages, postponed);
        self.tell_goals(changes, effects);
        self.act(course, effects);
    }

    /// Asks again, because the world has overtaken the answer.
    fn ask_again(&mut self, stopped: Vec<OperatorId>, effects: &mut Vec<Effect>) {
        let asked = self.patience.asks_again();
        if let Hand::Errand(errand) = &mut self.hand
            && let Purpose::Trouble(trouble) = &errand.purpose
        {
            // Somebody is being called already: there is time. A human who has come does not wait for a calmer world.
            return match (trouble, asked) {
                (Trouble::NoPlan(why), Err(_)) if errand.done => {
                    let why = why.clone();
                    self.end(Ending::WithHuman { why }, effects);
                }
                _ => {
                    self.moot(effects);
                    let Hand::Errand(errand) = &mut self.hand else { return };
                    errand.overtaken(self.moment.now);
                }
            };
        }
        match asked {
            Ok(times) => {
                effects.push(Effect::Tell(Narration::AskedAgain { times }));
                self.ask(stopped, effects);
            }
            Err(stuck) => self.escalate(stuck, effects),
        }
    }

    /// The only plans need steps that have just failed.
    fn barred(&mut self, why: NoPlan, effects: &mut Vec<Effect>) {
        let Some(sight) = &self.sight else { return };
        let (state, now) = (&sight.state, self.moment.now);
        let given_up = self.failures.given_up(state, now);
        if matches!(&self.hand, Hand::Errand(e) if matches!(e.purpose, Purpose::Trouble(_))) {
            return self.no_plan_during_errand(why, effects);
        }
        if !given_up.is_empty() {
            return match self.policy.escalation {
                Some(_) => self.escalate(Stuck::Attempts(given_up), effects),
                None => self.fall_back(why, effects),
            };
        }
        // A bar that has ended since the question was asked: ask without it.
        let until = self.failures.next_end(state, now).unwrap_or(now);
        let steps = self.failures.barred(state, now);
        let from = state.clone();
        let seconds = std::time::Duration::from_nanos(until.0 - now.0).as_secs_f64();
        self.stop(effects);
        effects.push(Effect::Tell(Narration::Resting { steps, seconds }));
        self.hand = Hand::Rest(Rest { from, until });
    }

    /// Withdraws what is being carried out.
    pub(super) fn stop(&mut self, effects: &mut Vec<Effect>) {
        let hand = self.take_hand();
        let Some(sight) = &self.sight else { return };
        match hand {
            Hand::Plan(mut course) => course.withdraw(&sight.snapshot, effects),
            Hand::Errand(mut errand) => errand.withdraw(&sight.snapshot, effects),
            Hand::Empty | Hand::Rest(_) => {}
        }
    }
}

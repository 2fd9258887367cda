//! One turn of the wheel: what is seen, then what follows from it, then when to turn next.

use super::course::Progress;
use super::effects::{in_one_transaction, is_write};
use super::errand::Purpose;
use super::event::{Effect, Event};
use super::sight::Sight;
use super::state::{Hand, Wheel};
use crate::model::Changes;
use crate::narration::Narration;
use crate::outcome::{Ending, StepFailure, Trouble};
use dsr::{Delta, Snapshot, Time, TransactionError};
use high_to_low::Moment;

impl Wheel {
    /// One turn. `now` is the time on the clock, never less than before.
    pub fn step(&mut self, event: Event, now: Time) -> Vec<Effect> {
        let mut effects = Vec::new();
        if self.ended && self.accomplished.is_empty() {
            return effects;
        }
        self.turn_clock(&event, now, &mut effects);
        match event {
            Event::Seen(snapshot) => self.look(snapshot, &mut effects),
            Event::Changed { snapshot, delta } => self.follow(snapshot, &delta, &mut effects),
            Event::Woke => self.advance(&mut effects),
            Event::Decided(id, decision) => {
                self.deferred = Some((id, decision));
                self.advance(&mut effects);
            }
            Event::Written => {
                self.unanswered = false;
                self.advance(&mut effects);
            }
            Event::Refused(why) => {
                self.unanswered = false;
                self.refused(why, &mut effects);
            }
        }
        if self.ended && self.is_undone(&mut effects) {
            self.advance(&mut effects);
        }
        let mut effects = in_one_transaction(effects);
        self.unanswered |= effects.iter().any(is_write);
        if !self.ended {
            let wake_at = self.clock.set(self.next_time());
            effects.extend(wake_at.map(Effect::WakeAt));
        }
        effects
    }

    /// The goals held in the end, and a version that was committed before anybody knew shows that one holds no longer: who
    /// asked for help in the last instant is not left alone.
    fn is_undone(&mut self, effects: &mut Vec<Effect>) -> bool {
        let holding = self.holding_goals();
        let lost: Vec<_> = self.accomplished.iter().copied().filter(|id| !holding.contains(id)).collect();
        if lost.is_empty() {
            return false;
        }
        self.accomplished.clear();
        self.ended = false;
        let changes = self.agenda.reopen(&lost, self.moment.now);
        self.tell_goals(changes, effects);
        true
    }

    /// A version is judged by the time of its own commit, a timer by the present. Nothing else tells how far the graph
    /// has been seen.
    fn turn_clock(&mut self, event: &Event, now: Time, effects: &mut Vec<Effect>) {
        if let Some(stop) = self.clock.turn(now) {
            effects.push(Effect::Tell(Narration::StoodStill { seconds: stop.as_secs_f64() }));
        }
        let now = self.clock.own(now);
        let seen = match event {
            Event::Seen(snapshot) | Event::Changed { snapshot, .. } => {
                self.clock.own(snapshot.time()).min(now)
            }
            Event::Woke => now,
            Event::Decided(..) | Event::Written | Event::Refused(_) => self.moment.seen,
        };
        self.moment = Moment { seen: seen.max(self.moment.seen), now };
    }

    /// Takes in a version of the graph as a whole.
    fn look(&mut self, snapshot: Snapshot, effects: &mut Vec<Effect>) {
        let mut sight = Sight::new(&self.perception, &self.model, snapshot, self.moment.now);
        self.model.task().change(&mut sight.state, self.under_way.iter().map(|&fact| (fact, true)));
        match self.sight.replace(sight) {
            None => {
                let sight = self.sight.as_ref().expect("it was just put there");
                self.patience.begins_with(&sight.state);
            }
            Some(before) => {
                let sight = self.sight.as_mut().expect("it was just put there");
                let changes = sight.differences(&before);
                if changes.is_empty() {
                    sight.since = before.since;
                }
                self.changed(&changes);
            }
        }
        self.follow_objects(None, effects);
        self.advance(effects);
    }

    /// Takes in a commit.
    fn follow(&mut self, snapshot: Snapshot, delta: &Delta, effects: &mut Vec<Effect>) {
        let Some(sight) = &mut self.sight else { return self.look(snapshot, effects) };
        let changes = sight.follow(&self.model, snapshot, delta, self.moment.now);
        self.changed(&changes);
        self.follow_objects(Some(delta), effects);
        self.advance(effects);
    }

    fn changed(&mut self, changes: &Changes) {
        if changes.is_empty() {
            return;
        }
        if let (Hand::Plan(course), Some(sight)) = (&mut self.hand, &self.sight) {
            course.observe(self.model.task(), &sight.state);
        }
        let became_true = changes.facts.iter().filter(|(_, now)| *now).map(|&(fact, _)| fact);
        if self.patience.became_true(became_true) {
            self.failures.progressed();
        }
    }

    /// Decides what to do from here, and does it.
    pub(super) fn advance(&mut self, effects: &mut Vec<Effect>) {
        if self.ended || self.sight.is_none() {
            return;
        }
        self.note_starts();
        // What was achieved counts, even if it is over when the wheel can decide again.
        self.follow_goals(effects);
        // Between asking for a write and seeing it, there is nothing to decide on.
        if self.unanswered {
            return;
        }
        if self.agenda.is_over() {
            return self.over(effects);
        }
        if self.horizon.is_some_and(|horizon| self.moment.now >= self.clock.horizon(horizon)) {
            return self.out_of_time(effects);
        }
        if let Some((id, decision)) = self.deferred.take()
            && let Some(inquiry) = self.inquiry.take_if(|inquiry| inquiry.id == id)
        {
            return self.decided(decision, inquiry, effects);
        }
        self.wait_for_decision(effects);
        if self.ended || effects.iter().any(is_write) {
            return;
        }
        if self.agenda.candidates().is_empty() {
            return self.idle(effects);
        }
        self.reconsider();
        match self.take_hand() {
            Hand::Empty => {
                if self.inquiry.is_none() {
                    self.ask(Vec::new(), effects);
                }
            }
            Hand::Plan(course) if self.inquiry.is_some() => self.hand = Hand::Plan(course),
            Hand::Plan(course) => self.act(course, effects),
            Hand::Rest(rest) => self.rest(rest, effects),
            Hand::Errand(errand) => self.carry(errand, effects),
        }
    }

    /// When to turn next even if nothing happens, in the wheel's time.
    fn next_time(&self) -> Option<Time> {
        let horizon = self.horizon.map(|horizon| self.clock.horizon(horizon));
        let hand = match &self.hand {
            Hand::Plan(course) if self.inquiry.is_none() => course.wake_at(),
            Hand::Rest(rest) => Some(rest.until),
            Hand::Errand(errand) => errand.wake_at(),
            Hand::Empty | Hand::Plan(_) => None,
        };
        let deadline = self.agenda.next_deadline();
        [horizon, hand, deadline, self.next_question(), self.decision_due()].into_iter().flatten().min()
    }

    /// The graph refused what the wheel wanted to write.
    fn refused(&mut self, why: TransactionError, effects: &mut Vec<Effect>) {
        effects.push(Effect::Tell(Narration::Refused { why: why.clone() }));
        match self.take_hand() {
            Hand::Plan(mut course) if self.inquiry.is_none() && !course.running().is_empty() => {
                // One transaction has the writes of all steps: none of them stands.
                let step = course.running()[0];
                let sight = self.sight.as_ref().expect("a plan is made from what was seen");
                course.withdraw(&sight.snapshot, effects);
                self.failed(course, step, StepFailure::Refused(why), effects);
            }
            // An errand goes on: the missing write is noticed at its deadline, and the next method is tried. To end here
            // would leave the person alone.
            other => {
                self.hand = other;
                self.advance(effects);
            }
        }
    }

    /// Every goal has ended.
    fn over(&mut self, effects: &mut Vec<Effect>) {
        let hand = self.take_hand();
        let sight = self.sight.as_ref().expect("the goals were seen to end");
        match hand {
            Hand::Plan(mut course) => match course.progress(self.model.task()) {
                Progress::Moves(steps) if steps.len() == course.left().len() => {
                    course.leave(&steps, &self.model, &sight.state, &sight.snapshot, effects);
                }
                _ => course.withdraw(&sight.snapshot, effects),
            },
            Hand::Errand(mut errand) => errand.withdraw(&sight.snapshot, effects),
            Hand::Empty | Hand::Rest(_) => {}
        }
        let ending = self.agenda_ending();
        if ending == Ending::Accomplished {
            self.accomplished = self.holding_goals();
        }
        self.end(ending, effects);
    }

    /// How a mission ends of which no goal is open.
    fn agenda_ending(&self) -> Ending {
        let goals = self.agenda.failed();
        if goals.is_empty() { Ending::Accomplished } else { Ending::GivenUp { goals } }
    }

    /// The run is over. A call that nobody has attended stands.
    fn out_of_time(&mut self, effects: &mut Vec<Effect>) {
        let ending = match self.take_hand() {
            Hand::Errand(errand) => match errand.purpose {
                Purpose::Trouble(Trouble::NoPlan(why)) if errand.done => Ending::WithHuman { why },
                Purpose::Trouble(why) => Ending::StillCalling { why },
                Purpose::Meanwhile => Ending::StillGoing,
            },
            // A robot that is there for what may come has done all that came.
            Hand::Empty if self.agenda.is_idle() => self.agenda_ending(),
            Hand::Empty | Hand::Plan(_) | Hand::Rest(_) => Ending::StillGoing,
        };
        self.end(ending, effects);
    }

    pub(super) fn end(&mut self, ending: Ending, effects: &mut Vec<Effect>) {
        self.moot(effects);
        self.ended = true;
        effects.push(Effect::Tell(Narration::Ended(ending.clone())));
        effects.push(Effect::End(ending));
    }
}

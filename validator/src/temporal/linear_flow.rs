//! Lets time pass if all continuous change is linear.

use super::active::Active;
use super::flow::{Flow, each_running};
use super::linear_change::LinearChange;
use super::run::{Checked, Run};
use super::watch::Ticket;
use crate::curve::Curve;
use crate::number::Number;
use crate::plan::end;
use crate::root::Instant;
use crate::scene::Clock;
use crate::state::Line;
use crate::value::Value;
use pddl::model::{Direction, GroundApplication};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

impl Run<'_, '_, '_> {
    /// Begins the continuous effects of an action.
    pub(super) fn begin_linear(&mut self, ticket: Ticket) {
        let Some(mut linear) = self.linear.take() else { return };
        match self.entered(&mut linear, ticket) {
            Some(()) => self.linear = Some(linear),
            None => self.stop_linear(),
        }
    }

    fn entered(&self, linear: &mut LinearChange, ticket: Ticket) -> Option<()> {
        let Active { action, binding, duration, .. } = self.active.get(ticket)?;
        let clock = Clock { duration: Some(*duration), ..Clock::at(self.now) };
        let scene = self.prepared.scene(self.state, &action.variables, clock);
        let mut running = Vec::new();
        for effect in &action.continuous {
            each_running(scene, effect, binding.clone(), &mut running).ok()?;
        }
        for effect in running {
            let rate = scene.number(effect.rate, &effect.binding).ok().filter(|rate| rate.is_exact())?;
            let share = if effect.direction == Direction::Decrease { rate.negated() } else { rate };
            let (sum, effects) = linear.rates.entry(effect.fluent.clone()).or_insert((Number::ZERO, 0));
            *sum = sum.plus(share).ok().filter(|sum| sum.is_exact())?;
            *effects += 1;
            linear.bent.insert(effect.fluent.clone());
            linear.shares.entry(ticket).or_default().push((effect.fluent, share));
        }
        Some(())
    }

    /// Ends the continuous effects of an action.
    pub(super) fn end_linear(&mut self, ticket: Ticket) {
        if self.linear.as_mut().is_some_and(|linear| linear.leave(ticket).is_none()) {
            self.stop_linear();
        }
    }

    /// Stops linear change for good: from now on the state stores all values.
    fn stop_linear(&mut self) {
        self.linear = None;
        self.state.settle_lines();
        self.watch.all_changed();
    }

    /// Lets time pass until just before `time`, if change is linear. Returns whether it did.
    pub(super) fn flow_linearly(&mut self, time: Number) -> Checked<bool> {
        let Some(mut linear) = self.linear.take() else { return Ok(false) };
        if !self.now.is_exact() || self.draw(&mut linear).is_none() {
            self.stop_linear();
            return Ok(false);
        }
        if self.state.has_lines() {
            let Some(due) = self.foresee(&mut linear) else {
                self.stop_linear();
                return Ok(false);
            };
            self.ask(&mut linear, due, time)?;
        } else {
            linear.calls.clear();
            self.invariants(self.now)?;
        }
        self.state.look_at(time);
        self.now = time;
        self.linear = Some(linear);
        Ok(true)
    }

    /// Computes the lines that have changed.
    fn draw(&mut self, linear: &mut LinearChange) -> Option<()> {
        for fluent in std::mem::take(&mut linear.bent) {
            let &(slope, effects) = linear.rates.get(&fluent)?;
            let value = self.state.fluent(&fluent);
            if effects == 0 {
                linear.rates.remove(&fluent);
            } else if !matches!(value, Some(Value::Number(value)) if value.is_exact()) {
                return None;
            }
            self.watch.flowed(&fluent);
            self.state.set_fluent(fluent.clone(), value);
            if slope != Number::ZERO && effects > 0 {
                self.state.draw_line(fluent, Line { since: self.now, slope });
            }
        }
        Some(())
    }

    /// Computes when the conditions that are due may change. Returns the actions of these
    /// conditions.
    fn foresee(&mut self, linear: &mut LinearChange) -> Option<BTreeSet<Ticket>> {
        let due = self.watch.due();
        for &ticket in &due {
            let Some((active, reads)) = self.active.with_reads(ticket) else { continue };
            let until = end(&self.plan.steps[active.step.0 as usize]);
            let length = until.minus(self.now).ok()?;
            let mut curves = Vec::new();
            let mut add = |fluent: &GroundApplication, line: &Line| {
                if let Some(Value::Number(value)) = self.state.fluent(fluent) {
                    curves.push((fluent.clone(), Curve::line(value, line.slope)));
                }
            };
            match reads.fluents() {
                Some(fluents) => fluents.for_each(|fluent| {
                    self.state.line(fluent).into_iter().for_each(|line| add(fluent, line));
                }),
                None => self.state.lines().for_each(|(fluent, line)| add(fluent, line)),
            }
            let round = linear.rounds.entry(ticket).or_insert(0);
            *round += 1;
            if curves.is_empty() {
                continue;
            }
            let mut critical = Vec::new();
            self.critical_of(active, &Flow::of(curves), length, &mut critical);
            for instant in critical {
                let Instant::At(after) = instant else { return None };
                let at = self.now.plus(after).ok().filter(|at| at.is_exact())?;
                linear.calls.push(Reverse((at, ticket, *round)));
            }
        }
        if linear.calls.len() > 2 * linear.kept + 1024 {
            let LinearChange { calls, rounds, kept, .. } = linear;
            calls.retain(|Reverse((_, ticket, round))| rounds.get(ticket) == Some(round));
            *kept = calls.len();
        }
        Some(due)
    }

    /// Checks the conditions that are due just after now. Checks those that may change until `time`
    /// at that instant and just after it.
    fn ask(&mut self, linear: &mut LinearChange, mut due: BTreeSet<Ticket>, time: Number) -> Checked {
        let mut called: BTreeMap<Number, BTreeSet<Ticket>> = BTreeMap::new();
        while let Some(&Reverse((at, ticket, round))) = linear.calls.peek().filter(|call| call.0.0 < time) {
            linear.calls.pop();
            if linear.rounds.get(&ticket) != Some(&round) {
                continue;
            }
            if at <= self.now {
                due.insert(ticket);
            } else {
                called.entry(at).or_default().insert(ticket);
            }
        }
        let mut before = self.now;
        let instants = called.into_iter().map(|(at, tickets)| (at, Some(tickets)));
        for (at, tickets) in instants.chain([(time, None)]) {
            let middle = before.plus(at).and_then(|sum| sum.over(Number::integer(2)));
            let Ok(middle) = middle else {
                self.state.work.mark_undecided();
                return Ok(());
            };
            self.ask_at(middle, &due)?;
            if let Some(tickets) = tickets {
                self.ask_at(at, &tickets)?;
                due = tickets;
            }
            before = at;
        }
        Ok(())
    }

    fn ask_at(&mut self, at: Number, tickets: &BTreeSet<Ticket>) -> Checked {
        self.state.look_at(at);
        let all: BTreeSet<Ticket> = tickets.iter().copied().chain(self.watch.always()).collect();
        all.into_iter().try_for_each(|ticket| self.invariant(ticket, at))
    }
}

//! Continuous change in straight lines, of which only what matters is looked at.
//!
//! Problem: with thousands of continuous effects at once, giving each fluent its value at each happening is quadratic.
//! Idea: where rates are numbers that nothing changes, a fluent runs in a straight line until an effect on it begins or
//! ends or something else sets it. So the state is told the line ([`Line`]) and works out the value when it is asked;
//! and when a condition can change is computed once for each line that it reads, and kept in a queue until then.
//!
//! Invariant: what is asked when is what `flow_to` asks without, but for conditions that cannot have changed. Where
//! that does not work (processes, events, axioms, constraints and traces look at everything; rates may change; an instant
//! may be no fraction) the lane is closed for good, and all values are what the state says.
//!
//! Cost: of a happening, the lines that it changes and the conditions that read them.

use super::active::{Active, Ticket};
use super::flow::Flow;
use super::nature::each_running;
use super::timeline::end;
use super::{Checked, Run};
use crate::curve::Curve;
use crate::number::Number;
use crate::root::Instant;
use crate::scene::Clock;
use crate::state::{Line, Value};
use pddl::model::{
    Direction, Domain, Effect, EffectKind, ExpressionKind, FunctionId, GroundApplication, Problem,
    TimedChange,
};
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap};

/// What runs in straight lines.
#[derive(Debug, Default)]
pub(super) struct Lane {
    /// Per fluent its rate and how many effects make it up.
    rates: FxHashMap<GroundApplication, (Number, usize)>,
    /// What each action adds to rates.
    shares: FxHashMap<Ticket, Vec<(GroundApplication, Number)>>,
    /// Fluents whose lines are to be drawn anew.
    bent: FxHashSet<GroundApplication>,
    /// When conditions may change, as long as their round is the last one of their action.
    calls: BinaryHeap<Reverse<(Number, Ticket, u64)>>,
    rounds: FxHashMap<Ticket, u64>,
    /// How many calls there were when those of earlier rounds were last thrown away.
    kept: usize,
}

/// The functions that something changes.
fn changing(domain: &Domain, problem: &Problem) -> FxHashSet<FunctionId> {
    let mut found = FxHashSet::default();
    let mut changed_by = |effect: &Effect| {
        effect.each(&mut |part| {
            if let EffectKind::Assign(_, application, _) = &part.kind {
                found.insert(application.function);
            }
        });
    };
    domain.actions.iter().for_each(|action| changed_by(&action.effect));
    let timed = domain.durative_actions.iter().flat_map(|action| &action.effects);
    timed.for_each(|timed| changed_by(&timed.effect));
    for action in &domain.durative_actions {
        found.extend(action.continuous.iter().map(|effect| effect.fluent.function));
    }
    for timed in &problem.timed {
        match &timed.change {
            TimedChange::Assign(fact) => found.insert(fact.application.function),
            TimedChange::Undefine(fluent) => found.insert(fluent.function),
            TimedChange::Add(_) | TimedChange::Delete(_) => false,
        };
    }
    found
}

impl Lane {
    /// A lane, if all continuous effects of the domain have rates that nothing changes, and nothing looks at everything.
    pub(super) fn open(domain: &Domain, problem: &Problem) -> Option<Self> {
        let continuous = || domain.durative_actions.iter().flat_map(|action| &action.continuous);
        if !domain.processes.is_empty()
            || !domain.events.is_empty()
            || !domain.axioms.is_empty()
            || continuous().next().is_none()
        {
            return None;
        }
        let changing = changing(domain, problem);
        let mut steady = true;
        for effect in continuous() {
            steady &= effect.functions.is_empty();
            effect.rate.each(&mut |part| {
                steady &= match &part.kind {
                    ExpressionKind::Fluent(application) => !changing.contains(&application.function),
                    ExpressionKind::TotalTime | ExpressionKind::IsViolated(_) => false,
                    ExpressionKind::Number(_) | ExpressionKind::Duration | ExpressionKind::Arithmetic(..) => {
                        true
                    }
                };
            });
        }
        steady.then(Self::default)
    }

    /// Something else may have set the fluent.
    pub(super) fn wrote(&mut self, fluent: &GroundApplication) {
        if self.rates.contains_key(fluent) {
            self.bent.insert(fluent.clone());
        }
    }

    /// An action no longer changes anything; `None` if the rate that is left is no fraction.
    fn leave(&mut self, ticket: Ticket) -> Option<()> {
        self.rounds.remove(&ticket);
        for (fluent, share) in self.shares.remove(&ticket).into_iter().flatten() {
            let (rate, effects) = self.rates.get_mut(&fluent)?;
            *rate = rate.minus(share).ok().filter(|rate| rate.is_exact())?;
            *effects -= 1;
            self.bent.insert(fluent);
        }
        Some(())
    }
}

impl Run<'_, '_, '_> {
    /// The continuous effects of an action begin.
    pub(super) fn enter_lane(&mut self, ticket: Ticket) {
        let Some(mut lane) = self.lane.take() else { return };
        match self.entered(&mut lane, ticket) {
            Some(()) => self.lane = Some(lane),
            None => self.close_lane(),
        }
    }

    fn entered(&self, lane: &mut Lane, ticket: Ticket) -> Option<()> {
        let Active { action, binding, duration, .. } = self.active.get(ticket)?;
        let clock = Clock { duration: Some(*duration), ..Clock::at(self.now) };
        let scene = self.validator.scene(self.state, &action.variables, clock);
        let mut running = Vec::new();
        for effect in &action.continuous {
            each_running(scene, effect, binding.clone(), &mut running).ok()?;
        }
        for effect in running {
            let rate = scene.number(effect.rate, &effect.binding).ok().filter(|rate| rate.is_exact())?;
            let share = if effect.direction == Direction::Decrease { rate.negated() } else { rate };
            let (sum, effects) = lane.rates.entry(effect.fluent.clone()).or_insert((Number::ZERO, 0));
            *sum = sum.plus(share).ok().filter(|sum| sum.is_exact())?;
            *effects += 1;
            lane.bent.insert(effect.fluent.clone());
            lane.shares.entry(ticket).or_default().push((effect.fluent, share));
        }
        Some(())
    }

    /// They end.
    pub(super) fn leave_lane(&mut self, ticket: Ticket) {
        if self.lane.as_mut().is_some_and(|lane| lane.leave(ticket).is_none()) {
            self.close_lane();
        }
    }

    /// From now on all fluents are looked at.
    fn close_lane(&mut self) {
        self.lane = None;
        self.state.settle_lines();
        self.watch.all_changed();
    }

    /// Lets time pass until just before `time`, if that can be done here.
    pub(super) fn flow_in_lane(&mut self, time: Number) -> Checked<bool> {
        let Some(mut lane) = self.lane.take() else { return Ok(false) };
        if !self.now.is_exact() || self.draw(&mut lane).is_none() {
            self.close_lane();
            return Ok(false);
        }
        if self.state.has_lines() {
            let Some(due) = self.foresee(&mut lane) else {
                self.close_lane();
                return Ok(false);
            };
            self.ask(&mut lane, due, time)?;
        } else {
            lane.calls.clear();
            self.invariants(self.now)?;
        }
        self.state.look_at(time);
        self.now = time;
        self.lane = Some(lane);
        Ok(true)
    }

    /// Draws the lines that are no longer what they were.
    fn draw(&mut self, lane: &mut Lane) -> Option<()> {
        for fluent in std::mem::take(&mut lane.bent) {
            let &(slope, effects) = lane.rates.get(&fluent)?;
            let value = self.state.fluent(&fluent);
            if effects == 0 {
                lane.rates.remove(&fluent);
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

    /// Looks ahead when the conditions that are due may change; answers whose they are.
    fn foresee(&mut self, lane: &mut Lane) -> Option<BTreeSet<Ticket>> {
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
            let round = lane.rounds.entry(ticket).or_insert(0);
            *round += 1;
            if curves.is_empty() {
                continue;
            }
            let mut critical = Vec::new();
            self.critical_of(active, &Flow::of(curves), length, &mut critical);
            for instant in critical {
                let Instant::At(after) = instant else { return None };
                let at = self.now.plus(after).ok().filter(|at| at.is_exact())?;
                lane.calls.push(Reverse((at, ticket, *round)));
            }
        }
        if lane.calls.len() > 2 * lane.kept + 1024 {
            let Lane { calls, rounds, kept, .. } = lane;
            calls.retain(|Reverse((_, ticket, round))| rounds.get(ticket) == Some(round));
            *kept = calls.len();
        }
        Some(due)
    }

    /// Asks what is due just after now, and what may change until `time` where it may and just after that.
    fn ask(&mut self, lane: &mut Lane, mut due: BTreeSet<Ticket>, time: Number) -> Checked {
        let mut called: BTreeMap<Number, BTreeSet<Ticket>> = BTreeMap::new();
        while let Some(&Reverse((at, ticket, round))) = lane.calls.peek().filter(|call| call.0.0 < time) {
            lane.calls.pop();
            if lane.rounds.get(&ticket) != Some(&round) {
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
                self.state.effort.give_up();
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

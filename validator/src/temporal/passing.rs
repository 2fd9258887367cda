//! Lets time pass between two happenings.

use super::flow::{Flow, Present};
use super::processes::{Autonomous, Instance};
use super::run::{Checked, Run};
use crate::number::Number;
use crate::root::{Instant, Undecided, in_order};
use crate::scene::Clock;
use crate::trace::Diff;
use crate::trajectory::Since;
use crate::verdict::{ChangeFault, NumericFault};
use pddl::model::ProcessId;

/// The most times that processes and events may begin and end at one instant.
const MOST_UNRESTS: usize = 100;

/// The number of such instants between two happenings above which their times seem to converge.
const MANY: usize = 10;

/// The most such instants in the whole plan: converging times would never end.
const MOST_UNRESTS_OF_ALL: usize = 10_000;

/// Marks the sorted instants and adds one between any two of them; the ends of `from..length` are
/// not included.
fn with_middles(
    critical: Vec<Instant>,
    from: &Instant,
    length: Number,
) -> Result<Vec<(Instant, bool)>, Undecided> {
    let mut later = Vec::with_capacity(critical.len());
    for instant in critical {
        if instant.compared(from)?.is_gt() {
            later.push(instant);
        }
    }
    let critical = in_order(later)?;
    let mut instants = Vec::with_capacity(2 * critical.len() + 1);
    let mut before = from.clone();
    for next in critical.into_iter().chain([Instant::At(length)]) {
        let middle = match (&before, &next) {
            (Instant::At(one), Instant::At(two)) => {
                let middle = one.plus(*two).and_then(|sum| sum.over(Number::integer(2)));
                middle.map_err(|_| Undecided)?
            }
            _ => before.between(&next)?,
        };
        instants.push((Instant::At(middle), false));
        instants.push((next.clone(), true));
        before = next;
    }
    instants.pop();
    Ok(instants)
}

/// Processes or events that begin or end.
struct Unrest {
    /// The time, relative to the last happening.
    after: Instant,
    autonomous: Autonomous,
}

/// Continuous change without a change of the curves.
struct Course {
    flow: Flow,
    /// The time at which its curves begin.
    origin: Number,
    /// The instant up to which it was followed.
    from: Instant,
}

impl Run<'_, '_, '_> {
    /// Lets time pass until just before `time`: applies continuous change, checks `over all`
    /// conditions, and lets processes and events begin and end.
    pub(super) fn flow_to(&mut self, time: Number, timed: bool, mut diff: Option<&mut Diff>) -> Checked {
        if self.now < time && self.flow_linearly(time)? {
            return Ok(());
        }
        let mut processes = self.processes(self.now);
        let mut course = None;
        let (mut unrests, mut met, mut passed) = (0, 0, Number::MAX);
        while course.is_some() || self.now < time {
            let Course { flow, origin, from } = match course.take() {
                Some(course) => course,
                None => self.course(&processes)?,
            };
            if flow.is_still() {
                self.invariants(self.now)?;
                self.now = time;
                break;
            }
            let length = time.minus(origin).unwrap_or(Number::ZERO);
            let unrest = self.flow_quietly(&flow, origin, &from, length, &processes)?;
            if self.state.work.is_undecided() {
                // Converging times become too close for any numbers.
                if passed < Number::thousandths(1) && met >= MANY {
                    self.state.work.clear_undecided();
                    return Err(self.change(ChangeFault::Unsteady));
                }
                break;
            }
            let Some(unrest) = unrest else {
                self.set(&flow, &Instant::At(length))?;
                self.now = time;
                break;
            };
            passed = unrest.after.near().minus(from.near()).unwrap_or(Number::ZERO);
            // Conditions that end each other at one instant would do so endlessly without time
            // passing.
            unrests = if passed < Number::NANO { unrests + 1 } else { 0 };
            self.unrests += 1;
            met += 1;
            if unrests > MOST_UNRESTS || self.unrests > MOST_UNRESTS_OF_ALL {
                return Err(self.change(ChangeFault::Unsteady));
            }
            self.set(&flow, &unrest.after)?;
            self.now = origin.plus(unrest.after.near()).unwrap_or(time);
            let happened = !unrest.autonomous.events.is_empty();
            self.wrote_fluents = false;
            self.events(unrest.autonomous.events, diff.as_deref_mut())?;
            let next = if happened { self.processes(self.now) } else { unrest.autonomous.processes };
            // While nothing changes the curves, they remain exact from their origin.
            if next == processes && !self.wrote_fluents {
                course = Some(Course { flow, origin, from: unrest.after });
            }
            processes = next;
            self.observe();
        }
        let due = self.due(self.now);
        if !due.is_empty() {
            self.timed_is_next = timed;
            self.events(due, diff)?;
            self.timed_is_next = false;
            self.observe();
        }
        Ok(())
    }

    /// The curves of the fluents from now on.
    fn course(&mut self, processes: &[Instance<ProcessId>]) -> Checked<Course> {
        if !self.state.rounded && !self.now.is_exact() {
            self.state.rounded = true;
            self.watch.all_changed();
        }
        let running = self.running(processes)?;
        let present = Present { universe: &self.prepared.universe, state: self.state, now: self.now };
        let flow = Flow::new(&running, present).map_err(|fault| self.change(fault))?;
        Ok(Course { flow, origin: self.now, from: Instant::At(Number::ZERO) })
    }

    /// Checks every instant inside `from..length` at which something can change. Returns the first
    /// one at which a process or event begins or ends.
    fn flow_quietly(
        &mut self,
        flow: &Flow,
        origin: Number,
        from: &Instant,
        length: Number,
        processes: &[Instance<ProcessId>],
    ) -> Checked<Option<Unrest>> {
        let mut last = from.clone();
        for (instant, critical) in self.instants_of(flow, from, length)? {
            if self.state.work.is_undecided() {
                break;
            }
            self.set(flow, &instant)?;
            let began = origin.plus(last.near()).unwrap_or(origin);
            let at = origin.plus(instant.near()).unwrap_or(origin);
            if self.has_processes_or_events() {
                let autonomous = self.autonomous(at);
                if !autonomous.events.is_empty() || autonomous.processes != processes {
                    // A change that is first seen between two instants began at the earlier one.
                    let after = if critical { instant } else { last };
                    return Ok(Some(Unrest { after, autonomous }));
                }
            }
            self.invariants(at)?;
            self.observe_at(if critical { Since::at(at) } else { Since::just_after(began) });
            if critical {
                last = instant;
            }
        }
        Ok(None)
    }

    pub(super) fn set(&mut self, flow: &Flow, after: &Instant) -> Checked {
        flow.fluents().for_each(|fluent| self.watch.flowed(fluent));
        flow.apply(after, self.state).map_err(|fault| {
            let fault = NumericFault::of(fault, pddl::Span::default());
            self.change(ChangeFault::Numeric(fault))
        })
    }

    /// The instants inside `from..length` at which conditions must be checked: those where one can
    /// change (`true`), and one between any two of them.
    fn instants_of(&mut self, flow: &Flow, from: &Instant, length: Number) -> Checked<Vec<(Instant, bool)>> {
        let mut critical = Vec::new();
        for ticket in self.watch.readers(flow.moving()) {
            let Some(active) = self.active.get(ticket) else { continue };
            self.critical_of(active, flow, length, &mut critical);
        }
        for (condition, variables, binding) in self.demands.conditions() {
            let scene = self.prepared.scene(self.state, variables, Clock::at(self.now));
            flow.critical(condition, scene, &mut binding.clone(), length, &mut critical);
        }
        if self.has_processes_or_events() {
            self.critical_of_processes(flow, from, length, &mut critical)?;
        }
        Ok(with_middles(critical, from, length).unwrap_or_else(|Undecided| {
            self.state.work.mark_undecided();
            Vec::new()
        }))
    }
}

//! A plan with times.
//!
//! The plan's starts and ends and the problem's timed changes are points on a time line. All that happens
//! at one time is judged in the state just before, must not interfere, and then changes the state
//! together. Between two times, what `over all` says must hold, and continuous effects run; a condition
//! over fluents that run is asked at each instant at which it can change and once between any two of them.
//!
//! Invariant: `now` is the time of the last happening, and `state` is the state right after it.
//!
//! Cost: the conditions of each point, and at each happening those of the running actions that read what changed
//! (`watch`), where change is linear only for the fluents that are read (`lane`); footprints only for points that are
//! nearer to another one than the separation.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definitions 16 to 20; Edelkamp & Hoffmann, "PDDL2.2", 2004.

mod active;
mod crowd;
mod flow;
mod footprint;
mod lane;
mod nature;
mod point;
mod timeline;
mod watch;

pub(crate) use flow::Passage;
pub(crate) use nature::bind_functions;
pub(crate) use timeline::{end, makespan, start};

use crate::cause::{Cause, Causes};
use crate::demands::Demands;
use crate::expression::NumericFault;
use crate::number::Number;
use crate::root::{Instant, Undecided, in_order};
use crate::run::{End, Validator};
use crate::scene::Clock;
use crate::state::{Moment, State};
use crate::trace::{Diff, Happening, Recorder, Trace};
use crate::trajectory::Since;
use crate::verdict::{ChangeFault, Failure, Valid};
use active::{Active, Actives, Ticket};
use crowd::Crowd;
use flow::{Flow, Present};
use footprint::{Dependencies, Footprint};
use lane::Lane;
use nature::{Instance, Nature};
use pddl::TemporalPlan;
use pddl::model::{Condition, DurativeAction, Given, ProcessId, TimeSpecifier};
use timeline::{Point, timeline};
use watch::{Basis, Watch};

/// How often what happens by itself may begin and end at one instant.
const MOST_UNRESTS: usize = 100;

/// How often it happens between two happenings of the plan where its times seem to have a limit.
const MANY: usize = 10;

/// How often it may do so in the whole plan: times that come ever nearer to each other never pass.
const MOST_UNRESTS_OF_ALL: usize = 10_000;

type Checked<T = ()> = Result<T, Box<Failure>>;

pub(crate) fn run(
    validator: &Validator<'_>,
    plan: &TemporalPlan,
    state: &mut State,
    mut trace: Option<&mut Trace>,
) -> Checked<Valid> {
    let points = timeline(validator.problem, plan);
    let dependencies = Dependencies::new(validator.domain);
    let mut run = Run {
        validator,
        plan,
        basis: Basis::new(validator.domain, &validator.strata, &dependencies),
        dependencies,
        demands: validator.demands(state),
        state,
        now: Number::ZERO,
        causes: Vec::new(),
        active: Actives::default(),
        lane: None,
        watch: Watch::default(),
        crowd: Crowd::default(),
        unrests: 0,
        wrote_fluents: false,
        timed_is_next: false,
        beside_timed: Vec::new(),
    };
    if trace.is_none() && run.demands.are_none() {
        run.lane = Lane::open(validator.domain, validator.problem);
    }
    let mut recorder = trace.as_mut().map(|trace| Recorder::new(validator, run.state, &mut trace.initial));
    if let Some(recorder) = &mut recorder {
        recorder.settle(run.state);
    }
    let due = run.due(run.now);
    run.events(due, None)?;
    run.observe();
    for happening in points.chunk_by(|a, b| a.time == b.time) {
        let mut diff = trace.is_some().then(Diff::default);
        let timed = happening.iter().any(|point| matches!(point.what, Cause::Timed(_)));
        run.flow_to(happening[0].time, timed, diff.as_mut())?;
        if let (Some(recorder), Some(diff)) = (&recorder, &mut diff) {
            recorder.before(run.state, diff);
        }
        run.happening(happening, crowded(&points, happening, validator.precision.separation), diff.as_mut())?;
        let due = run.due(run.now);
        run.events(due, diff.as_mut())?;
        if let (Some(trace), Some(recorder), Some(mut diff)) = (&mut trace, &mut recorder, diff) {
            let moment = run.moment();
            recorder.after(validator, run.state, moment, &mut diff);
            recorder.settle(run.state);
            let causes = happening.iter().map(|point| point.what).collect();
            trace.happenings.push(Happening { time: run.now, causes, diff });
        }
        run.observe();
    }
    let steps = u32::try_from(plan.steps.len()).unwrap_or(u32::MAX);
    let makespan = makespan(plan);
    if let Some((file, broken)) = run.demands.broken() {
        // Earlier states are gone; the last one is here.
        let asked = broken.asked.filter(|asked| asked.position == run.demands.last());
        let causes = Causes::Listed(&run.causes);
        let parts = asked
            .map(|asked| validator.lacks_of_constraint(run.state, (causes, run.now), &run.demands, asked));
        return Err(run.demands.failure(file, &broken, parts.unwrap_or_default()));
    }
    let end = End {
        state: run.state,
        causes: Causes::Listed(&run.causes),
        total_time: makespan,
        makespan: Some(makespan),
        steps,
    };
    if let Some(trace) = trace {
        trace.watched = run.demands.watched();
    }
    validator.finish(end, run.demands)
}

/// The instants in order, each marked, and one between any two of them; not the ends of `from..length` themselves.
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

/// Whether anything else happens at the time of a happening, or too near to it.
fn crowded(points: &[Point], happening: &[Point], separation: Number) -> bool {
    let time = happening[0].time;
    let near = |other: &Point| {
        let distance = if other.time > time { other.time.minus(time) } else { time.minus(other.time) };
        distance.is_ok_and(|distance| distance < separation)
    };
    let first = points.partition_point(|p| p.time < time);
    let before = first.checked_sub(1).and_then(|i| points.get(i));
    let after = points.get(first + happening.len());
    happening.len() > 1 || before.is_some_and(near) || after.is_some_and(near)
}

/// Something begins or ends by itself.
struct Unrest {
    /// When, after the last happening.
    after: Instant,
    nature: Nature,
}

/// Continuous change that goes on as it is.
struct Course {
    flow: Flow,
    /// The time from which its curves count.
    origin: Number,
    /// How far it has come.
    from: Instant,
}

struct Run<'s, 'v, 'a> {
    validator: &'v Validator<'a>,
    plan: &'v TemporalPlan,
    dependencies: Dependencies,
    basis: Basis<'v>,
    state: &'s mut State,
    demands: Demands<'v>,
    now: Number,
    causes: Vec<Cause>,
    active: Actives<'v>,
    /// Continuous change, as long as it runs in straight lines.
    lane: Option<Lane>,
    /// Who of them must be asked again.
    watch: Watch,
    /// What happened a moment ago.
    crowd: Crowd,
    /// How often something began or ended by itself.
    unrests: usize,
    /// Whether events changed a fluent since that was last asked.
    wrote_fluents: bool,
    /// Whether the problem changes something at the time that comes next.
    timed_is_next: bool,
    /// The events that happened just before it does.
    beside_timed: Vec<(Cause, Footprint)>,
}

impl<'v> Run<'_, 'v, '_> {
    fn moment(&self) -> Moment {
        Moment::try_from(self.causes.len()).unwrap_or(Moment::MAX)
    }

    fn derive_for(&mut self, condition: &Condition) {
        let moment = self.moment();
        self.validator.derive_for(condition, self.state, moment);
    }

    fn observe(&mut self) {
        self.observe_at(Since::at(self.now));
    }

    fn observe_at(&mut self, since: Since) {
        if self.demands.read_derived() {
            let moment = self.moment();
            self.validator.derive(self.state, moment);
        }
        self.demands.observe(since, &self.validator.universe, self.state);
    }

    /// Lets time pass until just before `time`: what runs, runs; what must hold all the time, must hold;
    /// what happens by itself, happens.
    fn flow_to(&mut self, time: Number, timed: bool, mut diff: Option<&mut Diff>) -> Checked {
        if self.now < time && self.flow_in_lane(time)? {
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
            if self.state.effort.is_undecided() {
                // Times that come ever nearer to each other get too near for any numbers.
                if passed < Number::thousandths(1) && met >= MANY {
                    self.state.effort.take_up();
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
            // Conditions that end each other at one instant would take no time, for ever.
            unrests = if passed < Number::NANO { unrests + 1 } else { 0 };
            self.unrests += 1;
            met += 1;
            if unrests > MOST_UNRESTS || self.unrests > MOST_UNRESTS_OF_ALL {
                return Err(self.change(ChangeFault::Unsteady));
            }
            self.set(&flow, &unrest.after)?;
            self.now = origin.plus(unrest.after.near()).unwrap_or(time);
            let happened = !unrest.nature.events.is_empty();
            self.wrote_fluents = false;
            self.events(unrest.nature.events, diff.as_deref_mut())?;
            let next = if happened { self.processes(self.now) } else { unrest.nature.processes };
            // As long as nothing changes the way that fluents run, they are known exactly from where they began.
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

    /// How fluents run from now on.
    fn course(&mut self, processes: &[Instance<ProcessId>]) -> Checked<Course> {
        if !self.state.rounded && !self.now.is_exact() {
            self.state.rounded = true;
            self.watch.all_changed();
        }
        let running = self.running(processes)?;
        let present = Present { universe: &self.validator.universe, state: self.state, now: self.now };
        let flow = Flow::new(&running, present).map_err(|fault| self.change(fault))?;
        Ok(Course { flow, origin: self.now, from: Instant::At(Number::ZERO) })
    }

    /// Looks at every instant inside `from..length` at which something can change; answers where something
    /// begins or ends by itself, if it does.
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
            if self.state.effort.is_undecided() {
                break;
            }
            self.set(flow, &instant)?;
            let began = origin.plus(last.near()).unwrap_or(origin);
            let at = origin.plus(instant.near()).unwrap_or(origin);
            if self.has_nature() {
                let nature = self.nature(at);
                if !nature.events.is_empty() || nature.processes != processes {
                    // What is first seen between two instants began at the earlier one.
                    let after = if critical { instant } else { last };
                    return Ok(Some(Unrest { after, nature }));
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

    fn set(&mut self, flow: &Flow, after: &Instant) -> Checked {
        flow.fluents().for_each(|fluent| self.watch.flowed(fluent));
        flow.apply(after, self.state).map_err(|fault| {
            let fault = NumericFault::of(fault, pddl::Span::default());
            self.change(ChangeFault::Numeric(fault))
        })
    }

    /// The instants inside `from..length` at which conditions must be asked: where one can change (`true`), and
    /// one between any two of them.
    fn instants_of(&mut self, flow: &Flow, from: &Instant, length: Number) -> Checked<Vec<(Instant, bool)>> {
        let mut critical = Vec::new();
        for ticket in self.watch.readers(flow.moving()) {
            let Some(active) = self.active.get(ticket) else { continue };
            self.critical_of(active, flow, length, &mut critical);
        }
        for (condition, variables, binding) in self.demands.conditions() {
            let scene = self.validator.scene(self.state, variables, Clock::at(self.now));
            flow.critical(condition, scene, &mut binding.clone(), length, &mut critical);
        }
        if self.has_nature() {
            self.critical_of_nature(flow, from, length, &mut critical)?;
        }
        Ok(with_middles(critical, from, length).unwrap_or_else(|Undecided| {
            self.state.effort.give_up();
            Vec::new()
        }))
    }

    /// Adds the instants inside `0..length` at which a condition of an action that runs may change.
    fn critical_of(&self, active: &Active<'_>, flow: &Flow, length: Number, into: &mut Vec<Instant>) {
        let clock = Clock { duration: Some(active.duration), ..Clock::at(self.now) };
        let scene = self.validator.scene(self.state, &active.action.variables, clock);
        let mut binding = active.binding.clone();
        for condition in over_all(active.action) {
            flow.critical(condition, scene, &mut binding, length, into);
        }
        for (effect, binding) in &active.armed {
            for condition in given(&active.action.effects[*effect].given, &TimeSpecifier::OverAll) {
                flow.critical(condition, scene, &mut binding.clone(), length, into);
            }
        }
        for (preference, binding) in &active.kept {
            let condition = &active.action.preferences[*preference].body.condition;
            flow.critical(condition, scene, &mut binding.clone(), length, into);
        }
    }

    /// Asks for everything that must hold all the time and may have changed.
    fn invariants(&mut self, at: Number) -> Checked {
        self.watch.due().into_iter().try_for_each(|ticket| self.invariant(ticket, at))
    }

    /// Asks for what must hold as long as an action runs.
    fn invariant(&mut self, ticket: Ticket, at: Number) -> Checked {
        let Some(&Active { step, action, duration, .. }) = self.active.get(ticket) else { return Ok(()) };
        for condition in over_all(action) {
            self.derive_for(condition);
            let clock = Clock { duration: Some(duration), ..Clock::at(at) };
            let scene = self.validator.scene(self.state, &action.variables, clock);
            let Some(Active { binding, .. }) = self.active.get_mut(ticket) else { continue };
            if !scene.holds(condition, binding) {
                let causes = Causes::Listed(&self.causes);
                let parts = self.validator.lacks(scene, causes, condition, binding);
                return Err(Box::new(Failure::Invariant { step, time: at, parts }));
            }
        }
        self.disarm(ticket, at);
        self.judge_kept(ticket, at);
        Ok(())
    }
}

impl Run<'_, '_, '_> {
    /// Drops the effects at the end whose condition `over all` does not hold.
    fn disarm(&mut self, ticket: Ticket, at: Number) {
        let Some(active) = self.active.get_mut(ticket) else { return };
        let (action, duration) = (active.action, active.duration);
        let mut armed = std::mem::take(&mut active.armed);
        let clock = Clock { duration: Some(duration), ..Clock::at(at) };
        armed.retain_mut(|(effect, binding)| {
            given(&action.effects[*effect].given, &TimeSpecifier::OverAll).all(|condition| {
                self.derive_for(condition);
                self.validator.scene(self.state, &action.variables, clock).holds(condition, binding)
            })
        });
        if let Some(active) = self.active.get_mut(ticket) {
            active.armed = armed;
        }
    }

    /// Counts the preferences over the whole time that do not hold now; each is counted once.
    fn judge_kept(&mut self, ticket: Ticket, at: Number) {
        let Some(active) = self.active.get_mut(ticket) else { return };
        let (action, duration) = (active.action, active.duration);
        let mut kept = std::mem::take(&mut active.kept);
        let clock = Clock { duration: Some(duration), ..Clock::at(at) };
        kept.retain_mut(|(preference, binding)| {
            let preference = &action.preferences[*preference];
            let condition = &preference.body.condition;
            self.derive_for(condition);
            let scene = self.validator.scene(self.state, &action.variables, clock);
            let holds = scene.holds(condition, binding);
            if !holds {
                self.demands.violations.add(preference, &action.variables, binding);
            }
            holds
        });
        if let Some(active) = self.active.get_mut(ticket) {
            active.kept = kept;
        }
    }
}

/// The conditions at a time that stand around an effect of another time.
fn given<'v>(given: &'v [Given], when: &TimeSpecifier) -> impl Iterator<Item = &'v Condition> {
    let timed = given.iter().flat_map(|given| match given {
        Given::When(conditions) => conditions.as_slice(),
        Given::Forall(_) => &[],
    });
    timed.filter(move |timed| timed.when == *when).map(|timed| &timed.condition)
}

/// What must hold from just after the start until just before the end.
fn over_all(action: &DurativeAction) -> impl Iterator<Item = &Condition> {
    action
        .conditions
        .iter()
        .filter(|timed| timed.when == TimeSpecifier::OverAll)
        .map(|timed| &timed.condition)
}

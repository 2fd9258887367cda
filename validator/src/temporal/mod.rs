//! Plans with times.
//!
//! The starts and ends of the steps and the problem's timed changes are points on a time line. All points at one time
//! are judged in the state just before them, must not interfere, and then change the state together. Between two
//! times, `over all` conditions must hold and continuous effects act. A condition over continuously changing fluents
//! is evaluated at each instant at which its truth can change, and once between any two such instants.
//!
//! Bottom up: `timeline`, `flow` (curves of fluents), `linear_change`, `footprint` and `concurrent`
//! (interference), `watch` and `active` (running actions). Then `run`, the execution of a plan,
//! with its parts: `invariants`, `processes`, `point`, `linear_flow`, `passing`.
//!
//! Cost: the conditions of each point, and at each happening the conditions of those running actions that read a
//! changed fact or fluent (`watch`). Where change is linear, only fluents that a condition reads are computed
//! (`linear_change`). Footprints are made only for points that are closer to another one than the separation.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definitions 16 to 20; Edelkamp & Hoffmann, "PDDL2.2", 2004.

mod active;
mod concurrent;
mod flow;
mod footprint;
mod invariants;
mod linear_change;
mod linear_flow;
mod passing;
mod point;
mod processes;
mod run;
mod timeline;
mod watch;

use crate::cause::{Cause, Causes};
use crate::number::Number;
use crate::plan::makespan;
use crate::prepared::{End, Prepared};
use crate::recorder::Recorder;
use crate::state::State;
use crate::trace::{Diff, Happening, Trace};
use crate::verdict::Valid;
use active::Actives;
use concurrent::Concurrent;
use footprint::Dependencies;
use linear_change::LinearChange;
use pddl::TemporalPlan;
use run::{Checked, Run};
use timeline::{Point, timeline};
use watch::{Basis, Watch};

pub(crate) fn run(
    prepared: &Prepared<'_>,
    plan: &TemporalPlan,
    state: &mut State,
    mut trace: Option<&mut Trace>,
) -> Checked<Valid> {
    let points = timeline(prepared.problem, plan);
    let dependencies = Dependencies::new(prepared.domain);
    let mut run = Run {
        prepared,
        plan,
        basis: Basis::new(prepared.domain, &prepared.strata, &dependencies),
        dependencies,
        demands: prepared.demands(state),
        state,
        now: Number::ZERO,
        causes: Vec::new(),
        active: Actives::default(),
        linear: None,
        watch: Watch::default(),
        concurrent: Concurrent::default(),
        unrests: 0,
        wrote_fluents: false,
        timed_is_next: false,
        beside_timed: Vec::new(),
    };
    if trace.is_none() && run.demands.are_none() {
        run.linear = LinearChange::open(prepared.domain, prepared.problem);
    }
    let mut recorder = trace.as_mut().map(|trace| Recorder::new(prepared, run.state, &mut trace.initial));
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
        run.happening(
            happening,
            concurrent(&points, happening, prepared.precision.separation),
            diff.as_mut(),
        )?;
        let due = run.due(run.now);
        run.events(due, diff.as_mut())?;
        if let (Some(trace), Some(recorder), Some(mut diff)) = (&mut trace, &mut recorder, diff) {
            let moment = run.moment();
            recorder.after(prepared, run.state, moment, &mut diff);
            recorder.settle(run.state);
            let causes = happening.iter().map(|point| point.what).collect();
            trace.happenings.push(Happening { time: run.now, causes, diff });
        }
        run.observe();
    }
    let steps = u32::try_from(plan.steps.len()).unwrap_or(u32::MAX);
    let makespan = makespan(plan);
    if let Some((file, broken)) = run.demands.broken() {
        // Earlier states are gone; only the last one is available.
        let asked = broken.asked.filter(|asked| asked.position == run.demands.last());
        let causes = Causes::Listed(&run.causes);
        let parts = asked
            .map(|asked| prepared.lacks_of_constraint(run.state, (causes, run.now), &run.demands, asked));
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
    prepared.finish(end, run.demands)
}

/// Whether another point is simultaneous with a happening, or too close to it.
fn concurrent(points: &[Point], happening: &[Point], separation: Number) -> bool {
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

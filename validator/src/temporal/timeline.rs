//! When things happen: the plan's starts and ends, and the problem's timed changes, in order of time.
//!
//! Times are exact, so two points are at one time or they are not. All timed changes of the problem
//! belong to the trajectory, those after the plan's end too: the goal must hold when all is over.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definition 18 (happening sequence); Edelkamp & Hoffmann,
//! "PDDL2.2", 2004, §3.

use crate::cause::Cause;
use crate::number::Number;
use crate::verdict::StepIndex;
use pddl::model::Problem;
use pddl::{StepHead, TemporalPlan, TemporalStep};

/// Something that happens at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) time: Number,
    pub(super) what: Cause,
}

/// The start of a step.
pub(crate) fn start(step: &TemporalStep) -> Number {
    Number::from_decimal(step.start)
}

/// The end of a step; its start if it takes no time or does not say how long it takes.
pub(crate) fn end(step: &TemporalStep) -> Number {
    let duration = match (step.head, step.duration) {
        (StepHead::DurativeAction(_), Some(duration)) => Number::from_decimal(duration),
        _ => Number::ZERO,
    };
    // Two decimals of a file have a sum, if need be a rounded one.
    start(step).plus(duration).unwrap_or(Number::MAX).max(start(step))
}

/// When the last step ends.
pub(crate) fn makespan(plan: &TemporalPlan) -> Number {
    plan.steps.iter().map(end).max().unwrap_or(Number::ZERO)
}

/// Everything that happens, by time; what happens at one time in the order of the file, a step's start before its end.
pub(super) fn timeline(problem: &Problem, plan: &TemporalPlan) -> Vec<Point> {
    let mut points = Vec::with_capacity(2 * plan.steps.len() + problem.timed.len());
    for (index, timed) in (0..).zip(&problem.timed) {
        points.push(Point { time: Number::from_decimal(timed.time), what: Cause::Timed(index) });
    }
    for (index, step) in (0..).map(StepIndex).zip(&plan.steps) {
        match step.head {
            StepHead::Action(_) => points.push(Point { time: start(step), what: Cause::Step(index) }),
            StepHead::DurativeAction(_) => {
                points.push(Point { time: start(step), what: Cause::Start(index) });
                points.push(Point { time: end(step), what: Cause::End(index) });
            }
        }
    }
    points.sort_by_key(|point| point.time);
    points
}

//! The time line: the plan's starts and ends and the problem's timed changes, in order of time.
//!
//! Times are exact, so two points are simultaneous or they are not. All timed changes belong to the trajectory,
//! including those after the plan's end: the goal must hold after the last of them.
//!
//! Source: Fox & Long, "PDDL2.1", JAIR 2003, Definition 18 (happening sequence); Edelkamp & Hoffmann, "PDDL2.2",
//! 2004, §3.

use crate::cause::Cause;
use crate::number::Number;
use crate::plan::{StepIndex, end, start};
use pddl::model::Problem;
use pddl::{StepHead, TemporalPlan};

/// Something that happens at a time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) time: Number,
    pub(super) what: Cause,
}

/// All points, sorted by time; simultaneous points in the order of the file, the start of a step
/// before its end.
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

//! The explanation of an unsolvable task as JSON; the planner provides the words.
//!
//! The record of such a task has
//!
//! ```json
//! {"unsolvable": {
//!   "parts": [{"place": {…}, "never": [{"literal": "(at attic)", "reason": 0}]}],
//!   "reasons": [{"literal": "(at attic)", "why": "givers", "more": 0, "givers": [
//!     {"by": "(go ?a attic)", "why": "needs", "needs": [{"literal": "(open ?a attic)", "reason": 1}], "together": []}]},
//!     {"literal": "(open ?a attic)", "why": "nothing_gives_it", "more": 0, "givers": []}],
//!   "exclusive": [{"atoms": ["(at a)", "(at b)"], "group": ["(at a)", "(at b)", "(at c)"]}],
//!   "space": null}}
//! ```
//!
//! A need that is not a literal is a comparison, `{"comparison": "(>= (fuel a) 10)", "measured": "(fuel a)",
//! "extent": "at_most", "bound": 7}`, or a condition of the goal, `{"condition": {…}}`, with its place.

use crate::plan::unsolvable::Unsolvable;
use crate::render::{At, PlaceRecord};
use crate::task::TaskFiles;
use planner::{
    Achiever, Explanation, Extent, FactId, Need, Never, NeverCompares, Number, Obstruction, Reason, ReasonId,
    Why,
};
use serde::Serialize;

/// The explanation as data.
#[derive(Serialize)]
pub(crate) struct UnsolvableRecord {
    parts: Vec<PartRecord>,
    reasons: Vec<ReasonRecord>,
    exclusive: Vec<ExclusiveRecord>,
    space: Option<SpaceRecord>,
}

impl UnsolvableRecord {
    /// The record of an explanation; `files` gives the places.
    pub(crate) fn of(unsolvable: &Unsolvable<'_>, files: &TaskFiles) -> Self {
        let place = |span| PlaceRecord::of(At { source: files.problem_source(), span });
        let never = |never: &Never| match never {
            Never::Literal(id) => literal(unsolvable, *id),
            Never::Number(own) => number(own),
            Never::Condition(span) => NeverRecord::Condition { condition: place(*span) },
        };
        let words = unsolvable.words();
        let Explanation { parts, reasons, exclusive, space } = &unsolvable.explanation;
        let goals = |goals: &[(FactId, bool)]| goals.iter().map(|&goal| words.goal(goal)).collect();
        Self {
            parts: parts
                .iter()
                .map(|part| PartRecord {
                    place: place(part.span),
                    never: part.never.iter().map(never).collect(),
                })
                .collect(),
            reasons: reasons.iter().map(|reason| reason_record(unsolvable, reason)).collect(),
            exclusive: exclusive
                .iter()
                .map(|pair| ExclusiveRecord { atoms: pair.pair.to_vec(), group: pair.group.clone() })
                .collect(),
            space: space.as_ref().map(|space| SpaceRecord {
                states: space.states,
                complete: space.complete,
                never: goals(&space.never),
                apart: space.apart.iter().map(|pair| goals(pair)).collect(),
                numbers: space
                    .numbers
                    .iter()
                    .map(|(fluent, low, high)| ExtentRecord {
                        fluent: unsolvable.task.fluent_name(fluent),
                        least: low.to_f64(),
                        most: high.to_f64(),
                    })
                    .collect(),
                nearest: NearestRecord {
                    steps: space.nearest.steps.iter().map(|&o| unsolvable.task.operator_name(o)).collect(),
                    missing: goals(&space.nearest.missing),
                },
            }),
        }
    }
}

fn literal(unsolvable: &Unsolvable<'_>, id: ReasonId) -> NeverRecord {
    NeverRecord::Literal {
        literal: unsolvable.words().wanted(&unsolvable.explanation.reason(id).wanted),
        reason: id.0,
    }
}

fn reason_record(unsolvable: &Unsolvable<'_>, reason: &Reason) -> ReasonRecord {
    let literal = unsolvable.words().wanted(&reason.wanted);
    let (why, givers, more) = match &reason.why {
        Why::NothingAchieves => ("nothing_gives_it", Vec::new(), 0),
        Why::Unexplored => ("not_looked_at", Vec::new(), 0),
        Why::Achievers { achievers, more } => {
            ("givers", achievers.iter().map(|achiever| giver_record(unsolvable, achiever)).collect(), *more)
        }
    };
    ReasonRecord { literal, why, givers, more }
}

fn giver_record(unsolvable: &Unsolvable<'_>, achiever: &Achiever) -> GiverRecord {
    let (why, needs, together) = match &achiever.obstruction {
        Obstruction::Needs(needs) => {
            let needs = needs.iter().map(|need| match need {
                Need::Literal(id) => literal(unsolvable, *id),
                Need::Number(own) => number(own),
            });
            ("needs", needs.collect(), Vec::new())
        }
        Obstruction::NeverTogether(all) => (
            "never_together",
            Vec::new(),
            all.iter().map(|wanted| unsolvable.words().wanted(wanted)).collect(),
        ),
        Obstruction::NeverApplies => ("never_applies", Vec::new(), Vec::new()),
        Obstruction::Excluded => ("excluded", Vec::new(), Vec::new()),
    };
    GiverRecord { by: unsolvable.words().achiever(achiever), why, needs, together }
}

fn number(never: &NeverCompares) -> NeverRecord {
    let (extent, bound): (_, Option<Number>) = match never.extent {
        Extent::Undefined => ("undefined", None),
        Extent::AtMost(bound) => ("at_most", Some(bound)),
        Extent::Below(bound) => ("below", Some(bound)),
        Extent::AtLeast(bound) => ("at_least", Some(bound)),
        Extent::Above(bound) => ("above", Some(bound)),
    };
    NeverRecord::Number {
        comparison: never.comparison.clone(),
        measured: never.measured.clone(),
        extent,
        bound: bound.map(Number::to_f64),
    }
}

#[derive(Serialize)]
struct PartRecord {
    place: PlaceRecord,
    never: Vec<NeverRecord>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum NeverRecord {
    Literal { literal: String, reason: u32 },
    Number { comparison: String, measured: String, extent: &'static str, bound: Option<f64> },
    Condition { condition: PlaceRecord },
}

#[derive(Serialize)]
struct ReasonRecord {
    literal: String,
    why: &'static str,
    givers: Vec<GiverRecord>,
    more: usize,
}

#[derive(Serialize)]
struct GiverRecord {
    by: Option<String>,
    why: &'static str,
    needs: Vec<NeverRecord>,
    together: Vec<String>,
}

#[derive(Serialize)]
struct ExclusiveRecord {
    atoms: Vec<String>,
    group: Vec<String>,
}

#[derive(Serialize)]
struct SpaceRecord {
    states: u32,
    complete: bool,
    never: Vec<String>,
    apart: Vec<Vec<String>>,
    numbers: Vec<ExtentRecord>,
    nearest: NearestRecord,
}

#[derive(Serialize)]
struct ExtentRecord {
    fluent: String,
    least: f64,
    most: f64,
}

#[derive(Serialize)]
struct NearestRecord {
    steps: Vec<String>,
    missing: Vec<String>,
}

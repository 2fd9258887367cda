//! Why there is no plan, as data; the planner has the words for it.
//!
//! As JSON the record of an unsolvable problem has
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
//! What is needed and is no literal is `{"comparison": "(>= (fuel a) 10)", "measured": "(fuel a)", "extent": "at_most",
//! "bound": 7}` or, of the goal, `{"condition": {…}}`, a place.

use crate::render::{At, PlaceRecord};
use crate::task::TaskFiles;
use planner::{
    Achiever, Budget, Explanation, Extent, FactId, Need, Never, NeverCompares, Number, Obstruction, Query,
    Reason, ReasonId, Task, UnsolvableReason, Why, Wording, explain,
};
use serde::Serialize;

/// An explanation with the names of its task.
pub(crate) struct Unsolvable<'a> {
    task: &'a Task,
    explanation: Explanation,
}

impl<'a> Unsolvable<'a> {
    /// Explains; `budget` bounds it.
    pub(crate) fn of(
        domain: &pddl::model::Domain,
        problem: &pddl::model::Problem,
        task: &'a Task,
        reason: &UnsolvableReason,
        budget: &Budget<'_>,
    ) -> Self {
        Self { task, explanation: explain(domain, problem, task, &Query::of(task), reason, budget) }
    }

    /// The same in words.
    pub(crate) fn words(&self) -> Wording<'_> {
        Wording::new(self.task, &self.explanation)
    }

    /// As data.
    pub(super) fn record(&self, files: &TaskFiles) -> UnsolvableRecord {
        let place = |span| PlaceRecord::of(At { source: files.problem_source(), span });
        let never = |never: &Never| match never {
            Never::Literal(id) => self.literal(*id),
            Never::Number(own) => number(own),
            Never::Condition(span) => NeverRecord::Condition { condition: place(*span) },
        };
        let words = self.words();
        let Explanation { parts, reasons, exclusive, space } = &self.explanation;
        let goals = |goals: &[(FactId, bool)]| goals.iter().map(|&goal| words.goal(goal)).collect();
        UnsolvableRecord {
            parts: parts
                .iter()
                .map(|part| PartRecord {
                    place: place(part.span),
                    never: part.never.iter().map(never).collect(),
                })
                .collect(),
            reasons: reasons.iter().map(|reason| self.reason_record(reason)).collect(),
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
                        fluent: self.task.fluent_name(fluent),
                        least: low.to_f64(),
                        most: high.to_f64(),
                    })
                    .collect(),
                nearest: NearestRecord {
                    steps: space.nearest.steps.iter().map(|&o| self.task.operator_name(o)).collect(),
                    missing: goals(&space.nearest.missing),
                },
            }),
        }
    }

    fn literal(&self, id: ReasonId) -> NeverRecord {
        NeverRecord::Literal {
            literal: self.words().wanted(&self.explanation.reason(id).wanted),
            reason: id.0,
        }
    }

    fn reason_record(&self, reason: &Reason) -> ReasonRecord {
        let literal = self.words().wanted(&reason.wanted);
        let (why, givers, more) = match &reason.why {
            Why::NothingAchieves => ("nothing_gives_it", Vec::new(), 0),
            Why::Unexplored => ("not_looked_at", Vec::new(), 0),
            Why::Achievers { achievers, more } => {
                ("givers", achievers.iter().map(|achiever| self.giver_record(achiever)).collect(), *more)
            }
        };
        ReasonRecord { literal, why, givers, more }
    }

    fn giver_record(&self, achiever: &Achiever) -> GiverRecord {
        let (why, needs, together) = match &achiever.obstruction {
            Obstruction::Needs(needs) => {
                let needs = needs.iter().map(|need| match need {
                    Need::Literal(id) => self.literal(*id),
                    Need::Number(own) => number(own),
                });
                ("needs", needs.collect(), Vec::new())
            }
            Obstruction::NeverTogether(all) => {
                ("never_together", Vec::new(), all.iter().map(|wanted| self.words().wanted(wanted)).collect())
            }
            Obstruction::NeverApplies => ("never_applies", Vec::new(), Vec::new()),
            Obstruction::Excluded => ("excluded", Vec::new(), Vec::new()),
        };
        GiverRecord { by: self.words().achiever(achiever), why, needs, together }
    }
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

/// The explanation as data.
#[derive(Serialize)]
pub(super) struct UnsolvableRecord {
    parts: Vec<PartRecord>,
    reasons: Vec<ReasonRecord>,
    exclusive: Vec<ExclusiveRecord>,
    space: Option<SpaceRecord>,
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

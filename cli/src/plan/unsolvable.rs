//! Why there is no plan: a sentence, a tree of reasons below it, and the same as data.
//!
//! As JSON the record of an unsolvable problem has
//!
//! ```json
//! {"unsolvable": {
//!   "parts": [{"place": {…}, "never": [{"literal": "(at attic)", "reason": 0}]}],
//!   "reasons": [{"literal": "(at attic)", "why": "givers", "more": 0, "givers": [
//!     {"by": "(go ?a attic)", "why": "needs", "needs": [{"literal": "(open ?a attic)", "reason": 1}], "together": []}]},
//!     {"literal": "(open ?a attic)", "why": "nothing gives it", "more": 0, "givers": []}],
//!   "exclusive": [{"atoms": ["(at a)", "(at b)"], "group": ["(at a)", "(at b)", "(at c)"]}],
//!   "space": null}}
//! ```
//!
//! What is needed and is no literal is `{"comparison": "(>= (fuel a) 10)", "measured": "(fuel a)", "extent": "at most",
//! "bound": 7}` or, of the goal, `{"condition": {…}}`, a place.

use crate::render::{At, PlaceRecord, counted};
use crate::task::TaskFiles;
use planner::{
    Budget, Explanation, Extent, FactId, Giver, Hindrance, Need, Never, NeverCompares, Number, Reason,
    ReasonId, Space, Task, UnsolvableReason, Wanted, Why, explain,
};
use serde::Serialize;

/// Lines of a tree, and names in a list.
const LINES: usize = 40;
const NAMES: usize = 12;

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
        Self { task, explanation: explain(domain, problem, task, reason, budget) }
    }

    /// The whole in a sentence.
    pub(crate) fn sentence(&self) -> String {
        let Explanation { parts, exclusive, space, .. } = &self.explanation;
        let mut sentences = Vec::new();
        let single = |never: &[Never]| matches!(never, [Never::Literal(_)]);
        let plain: Vec<String> =
            parts.iter().filter(|p| single(&p.never)).map(|p| self.never(&p.never[0])).collect();
        if !plain.is_empty() {
            sentences
                .push(format!("the goal needs {}, which nothing can bring about", listed(&plain, "and")));
        }
        for part in parts.iter().filter(|p| !single(&p.never)) {
            let all: Vec<String> = part.never.iter().map(|never| self.never(never)).collect();
            sentences.push(match part.never.as_slice() {
                [Never::Number(own)] => format!("the goal needs {}, but {}", own.comparison, bounded(own)),
                [Never::Condition(_)] => "a part of the goal is never true".to_owned(),
                _ => format!("the goal needs {}, and nothing can bring any of it about", listed(&all, "or")),
            });
        }
        for pair in exclusive {
            let [a, b] = &pair.pair;
            sentences.push(format!("the goal needs {a} and {b} together, which exclude each other"));
        }
        if sentences.is_empty() {
            sentences.push(match space {
                Some(_) => "no reachable state satisfies the goal".to_owned(),
                None => "nothing can bring the goal about".to_owned(),
            });
        }
        sentences.join("; ")
    }

    /// What is below the sentence, a line each.
    pub(crate) fn lines(&self) -> Vec<String> {
        let mut tree =
            Tree { of: self, shown: vec![false; self.explanation.reasons.len()], lines: Vec::new() };
        for part in &self.explanation.parts {
            for never in &part.never {
                if let Never::Literal(id) = never {
                    tree.reason(*id, 1);
                }
            }
        }
        let mut lines = tree.lines;
        let more = lines.len().saturating_sub(LINES);
        lines.truncate(LINES);
        if more > 0 {
            lines.push(format!("  and {more} more"));
        }
        for pair in &self.explanation.exclusive {
            let [a, b] = &pair.pair;
            lines.push(format!("  {a} and {b}: both can't hold at once: group {}", first(&pair.group)));
        }
        if let Some(space) = &self.explanation.space {
            self.space(space, &mut lines);
        }
        lines
    }

    fn space(&self, space: &Space, lines: &mut Vec<String>) {
        let names =
            |goals: &[(FactId, bool)]| first(&goals.iter().map(|&goal| self.goal(goal)).collect::<Vec<_>>());
        let states = counted(space.states as usize, "state", "states");
        let steps = match space.nearest.steps.len() {
            0 => "the initial one".to_owned(),
            n => format!("after {}", counted(n, "step", "steps")),
        };
        let missing = names(&space.nearest.missing);
        lines.push(if space.complete {
            format!("  exhausted: {states}; the nearest to the goal, {steps}, misses {missing}")
        } else {
            format!("  exhausted; of the first {states} the nearest to the goal, {steps}, misses {missing}")
        });
        if !space.never.is_empty() {
            lines.push(format!("  in no state: {}", names(&space.never)));
        }
        for &[a, b] in space.apart.iter().take(NAMES) {
            lines.push(format!("  never together: {} and {}", self.goal(a), self.goal(b)));
        }
        if space.apart.len() > NAMES {
            lines.push(format!("  and {} more pairs", space.apart.len() - NAMES));
        }
        for (fluent, low, high) in space.numbers.iter().take(NAMES) {
            lines.push(format!("  {} is between {low} and {high}", self.task.fluent_name(fluent)));
        }
    }

    fn never(&self, never: &Never) -> String {
        match never {
            Never::Literal(id) => self.wanted(&self.explanation.reason(*id).wanted),
            Never::Number(own) => own.comparison.clone(),
            Never::Condition(_) => "a condition that is never true".to_owned(),
        }
    }

    fn wanted(&self, wanted: &Wanted) -> String {
        let name = self.task.pattern_name(&wanted.pattern);
        if wanted.positive { name } else { format!("(not {name})") }
    }

    fn goal(&self, (fact, positive): (FactId, bool)) -> String {
        let known = &self.task.facts()[fact];
        let name = if known.atom.is_none() && known.value.is_none() && !known.compares {
            "(or …)".to_owned()
        } else {
            self.task.fact_name(fact)
        };
        if positive { name } else { format!("(not {name})") }
    }

    fn giver(&self, giver: &Giver) -> Option<String> {
        giver.action.map(|action| self.task.schema_name(action, &giver.arguments))
    }

    /// As data.
    pub(super) fn record(&self, files: &TaskFiles) -> UnsolvableRecord {
        let place = |span| PlaceRecord::of(At { source: &files.problem_source, span });
        let never = |never: &Never| match never {
            Never::Literal(id) => self.literal(*id),
            Never::Number(own) => number(own),
            Never::Condition(span) => NeverRecord::Condition { condition: place(*span) },
        };
        let Explanation { parts, reasons, exclusive, space } = &self.explanation;
        let goals = |goals: &[(FactId, bool)]| goals.iter().map(|&goal| self.goal(goal)).collect();
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
        NeverRecord::Literal { literal: self.wanted(&self.explanation.reason(id).wanted), reason: id.0 }
    }

    fn reason_record(&self, reason: &Reason) -> ReasonRecord {
        let literal = self.wanted(&reason.wanted);
        let (why, givers, more) = match &reason.why {
            Why::NothingGives => ("nothing gives it", Vec::new(), 0),
            Why::Unexplored => ("not looked at", Vec::new(), 0),
            Why::Givers { givers, more } => {
                ("givers", givers.iter().map(|giver| self.giver_record(giver)).collect(), *more)
            }
        };
        ReasonRecord { literal, why, givers, more }
    }

    fn giver_record(&self, giver: &Giver) -> GiverRecord {
        let (why, needs, together) = match &giver.hindrance {
            Hindrance::Needs(needs) => {
                let needs = needs.iter().map(|need| match need {
                    Need::Literal(id) => self.literal(*id),
                    Need::Number(own) => number(own),
                });
                ("needs", needs.collect(), Vec::new())
            }
            Hindrance::NeverTogether(all) => {
                ("never together", Vec::new(), all.iter().map(|wanted| self.wanted(wanted)).collect())
            }
            Hindrance::NeverApplies => ("never applies", Vec::new(), Vec::new()),
        };
        GiverRecord { by: self.giver(giver), why, needs, together }
    }
}

/// Reasons as lines, each reason once.
struct Tree<'a> {
    of: &'a Unsolvable<'a>,
    shown: Vec<bool>,
    lines: Vec<String>,
}

impl Tree<'_> {
    fn reason(&mut self, id: ReasonId, depth: usize) {
        if std::mem::replace(&mut self.shown[id.0 as usize], true) {
            return;
        }
        let of = self.of;
        let reason = of.explanation.reason(id);
        let (indent, wanted) = ("  ".repeat(depth), of.wanted(&reason.wanted));
        match &reason.why {
            Why::NothingGives if reason.wanted.positive => {
                self.lines.push(format!("{indent}nothing gives {wanted}"));
            }
            Why::NothingGives => {
                let name = of.task.pattern_name(&reason.wanted.pattern);
                self.lines.push(format!("{indent}nothing takes {name} away"));
            }
            Why::Unexplored => self.lines.push(format!("{indent}{wanted} is never true")),
            Why::Givers { givers, more } => {
                for giver in givers {
                    self.giver(&wanted, giver, depth);
                }
                if *more > 0 {
                    self.lines.push(format!("{indent}{wanted}: and {more} more ways, all barred"));
                }
            }
        }
    }

    fn giver(&mut self, wanted: &str, giver: &Giver, depth: usize) {
        let of = self.of;
        let by = of.giver(giver).unwrap_or_else(|| "its axiom".to_owned());
        let head = format!("{}{wanted} by {by}", "  ".repeat(depth));
        match &giver.hindrance {
            Hindrance::Needs(needs) => {
                let all: Vec<String> = needs
                    .iter()
                    .map(|need| match need {
                        Need::Literal(id) => {
                            let name = of.wanted(&of.explanation.reason(*id).wanted);
                            if self.shown[id.0 as usize] { format!("{name} (see above)") } else { name }
                        }
                        Need::Number(own) => format!("{}, but {}", own.comparison, bounded(own)),
                    })
                    .collect();
                self.lines.push(format!("{head} needs {}", listed(&all, "and")));
                for need in needs {
                    if let Need::Literal(id) = need {
                        self.reason(*id, depth + 1);
                    }
                }
            }
            Hindrance::NeverTogether(all) => {
                let all: Vec<String> = all.iter().map(|wanted| of.wanted(wanted)).collect();
                self.lines.push(format!("{head} needs {}, never for the same objects", listed(&all, "and")));
            }
            Hindrance::NeverApplies => {
                self.lines.push(format!("{head}, but what it needs never holds together"));
            }
        }
    }
}

/// `(fuel a) never gets above 7`.
fn bounded(never: &NeverCompares) -> String {
    let measured = &never.measured;
    match never.extent {
        Extent::Undefined => format!("{measured} never has a value"),
        Extent::AtMost(bound) => format!("{measured} never gets above {bound}"),
        Extent::Below(bound) => format!("{measured} stays below {bound}"),
        Extent::AtLeast(bound) => format!("{measured} never gets below {bound}"),
        Extent::Above(bound) => format!("{measured} stays above {bound}"),
    }
}

/// `a, b and c`.
fn listed(all: &[String], last: &str) -> String {
    match all {
        [] => String::new(),
        [one] => one.clone(),
        [before @ .., one] => format!("{} {last} {one}", before.join(", ")),
    }
}

/// The first of many.
fn first(all: &[String]) -> String {
    let shown = all.iter().take(NAMES).cloned().collect::<Vec<_>>().join(", ");
    if all.len() > NAMES { format!("{shown} and {} more", all.len() - NAMES) } else { shown }
}

fn number(never: &NeverCompares) -> NeverRecord {
    let (extent, bound): (_, Option<Number>) = match never.extent {
        Extent::Undefined => ("undefined", None),
        Extent::AtMost(bound) => ("at most", Some(bound)),
        Extent::Below(bound) => ("below", Some(bound)),
        Extent::AtLeast(bound) => ("at least", Some(bound)),
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

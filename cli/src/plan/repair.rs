//! `pelea plan --repair OLD_PLAN`: what can be reused of a plan that no longer fits, beside a new plan.
//!
//! Both are validated, and both are reported with their cost, their distance from the old plan, the time and the
//! states that they took; the preference decides which one is written. As JSON the last record has
//!
//! ```json
//! {"repair": {"old": "OLD_PLAN", "old_steps": 4, "left_out": ["(fly a b)"], "prefer": "stability", "way": "reuse",
//!   "reused": {"steps": 5, "cost": 5, "distance": 1, "removed": 0, "added": 1, "moved": 0, "search_ms": 0.1,
//!              "expanded": 3},
//!   "scratch": {…}, "scratch_limit": null}}
//! ```
//!
//! `reused` and `scratch` are null where there is no such plan; `scratch_limit` says which limit ended the search for a
//! new one.

use super::{bug, limit_words, written};
use crate::clock::{Deadline, Seconds, Stopwatch};
use crate::console::Console;
use crate::exit::Exit;
use crate::render::{show, show_all};
use crate::task::{TaskFiles, read_source};
use clap::ValueEnum;
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::model::{ActionId, ObjectId};
use pddl::{Plan, PlanStep, Severity, parse_plan};
use planner::{
    Attempt, Budget, OperatorId, Outcome, Preference, Query, Repair, Repaired, Report, SearchConfiguration,
    Task, Way,
};
use serde::Serialize;
use std::collections::HashMap;
use std::path::Path;
use std::time::Duration;
use validator::{Number, Verdict};

/// What decides between the repaired plan and the new one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Prefer {
    /// The one that is nearer to the old plan.
    #[default]
    Stability,
    /// The cheaper one.
    Cost,
    /// The first one: a new plan is looked for only where nothing can be reused.
    Speed,
}

impl Prefer {
    fn preference(self) -> Preference {
        match self {
            Self::Stability => Preference::Stability,
            Self::Cost => Preference::Cost,
            Self::Speed => Preference::Fastest,
        }
    }
}

/// The plan that no longer fits.
pub(super) struct OldPlan {
    sources: Sources,
    file: SourceId,
    steps: Vec<PlanStep>,
}

impl OldPlan {
    /// Reads it; what is wrong is shown.
    ///
    /// # Errors
    /// The exit code where it cannot be read, or is no sequence of steps.
    pub(super) fn read(path: &Path, files: &TaskFiles, console: &mut Console<'_>) -> Result<Self, Exit> {
        let (sources, file) = Sources::of(read_source(path, console)?);
        let parsed = parse_plan(&sources[file], &files.domain, &files.problem);
        let findings: Vec<_> = parsed.diagnostics.iter().map(|d| d.finding(file)).collect();
        let worst = show_all(&sources, &findings, console);
        let kind = match parsed.model {
            Some(Plan::Sequential(plan)) => return Ok(Self { sources, file, steps: plan.steps }),
            Some(Plan::Temporal(_)) => "a plan with times",
            Some(Plan::Hierarchical(_)) => "a plan with its decomposition",
            None if worst == Some(Severity::Unsupported) => return Err(Exit::Unsupported),
            None => return Err(Exit::Unreadable),
        };
        let refusal = Finding::answer(Sources::start_of(file), format!("{kind} cannot be repaired"));
        show(&sources, &Finding { severity: Severity::Unsupported, ..refusal }, console);
        Err(Exit::Unsupported)
    }

    /// Its steps as operators; those that no operator stands for are shown and left out.
    fn operators(&self, task: &Task, console: &mut Console<'_>) -> (Vec<OperatorId>, Vec<String>) {
        let mut known: HashMap<(ActionId, &[ObjectId]), Option<OperatorId>> =
            self.steps.iter().map(|step| ((step.action, step.arguments.as_slice()), None)).collect();
        for (id, operator) in task.operators().enumerate() {
            if let Some(place) = known.get_mut(&(operator.action, operator.arguments)) {
                place.get_or_insert(id);
            }
        }
        let (mut operators, mut left_out) = (Vec::new(), Vec::new());
        for step in &self.steps {
            if let Some(&Some(operator)) = known.get(&(step.action, step.arguments.as_slice())) {
                operators.push(operator);
                continue;
            }
            let text = self.sources[self.file].slice(step.span);
            left_out.push(text.to_owned());
            if left_out.len() > WARNINGS {
                continue;
            }
            let place = Place { source: self.file, span: step.span };
            let message = format!(
                "{text} can never be done in this problem, or does nothing for its goal; it is left out"
            );
            let severity = Severity::Warning;
            show(&self.sources, &Finding { severity, ..Finding::answer(place, message) }, console);
        }
        if left_out.len() > WARNINGS {
            console.note(&format!("left out as well: {}", left_out[WARNINGS..].join(" ")));
        }
        (operators, left_out)
    }
}

/// What became of the old plan.
#[derive(Serialize)]
pub(super) struct RepairRecord {
    old: String,
    old_steps: usize,
    left_out: Vec<String>,
    prefer: Prefer,
    way: Option<Way>,
    reused: Option<Figures>,
    scratch: Option<Figures>,
    scratch_limit: Option<&'static str>,
}

/// A plan, what it took, and how far it is from the old one.
#[derive(Serialize)]
struct Figures {
    steps: usize,
    cost: Number,
    distance: usize,
    removed: usize,
    added: usize,
    moved: usize,
    search_ms: f64,
    expanded: u64,
}

impl Figures {
    fn line(&self, name: &str) -> String {
        let moved = if self.moved > 0 { format!(", {} moved", self.moved) } else { String::new() };
        format!(
            "{name}: {} steps, cost {}, distance {} (+{} -{}{moved}), {} ms, {} expanded",
            self.steps, self.cost, self.distance, self.added, self.removed, self.search_ms, self.expanded
        )
    }
}

/// Steps that are left out, each with its place.
const WARNINGS: usize = 3;
/// A new plan is looked for so many times as long as it took to repair the old one, and at least so long.
const PATIENCE: (f64, Duration) = (10.0, Duration::from_secs(1));

/// Repairs the plan.
///
/// # Errors
/// The exit code if a plan is invalid; the reason has been shown.
pub(super) fn run(
    (files, task): (&TaskFiles, &Task),
    old: &OldPlan,
    prefer: Prefer,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
    console: &mut Console<'_>,
) -> Result<(RepairRecord, Report), Exit> {
    let (broken, left_out) = old.operators(task, console);
    let repair = Repair { task, query: Query::of(task), broken: &broken };
    let watch = Stopwatch::start();
    let reused = repair.reuse(budget);
    let reused_ms = watch.milliseconds();
    let is_reused = reused.plan().is_some();
    let (mut fresh, mut fresh_ms) = (None, 0.0);
    if !is_reused || prefer != Prefer::Speed {
        let watch = Stopwatch::start();
        let patience = Duration::from_secs_f64(reused_ms * PATIENCE.0 / 1000.0).max(PATIENCE.1);
        let deadline = Deadline::after(is_reused.then_some(Seconds::from(patience)));
        let interrupted = || deadline.is_over() || (budget.interrupted)();
        fresh = Some(repair.afresh(configuration, &Budget { interrupted: &interrupted, ..*budget }));
        fresh_ms = watch.milliseconds();
    }
    let repaired = Repaired::of(prefer.preference(), reused, fresh);

    let mut figures = |attempt: &Attempt, search_ms: f64| {
        let Some((plan, distance)) = attempt.plan() else { return Ok(None) };
        let (text, steps) = written(task, plan);
        let cost = match validator::validate(&files.domain, &files.problem, &steps) {
            Verdict::Valid(valid) => valid.cost(),
            verdict => return Err(bug(&verdict, &steps, &text, files, console)),
        };
        let removed = distance.removed + left_out.len();
        Ok(Some(Figures {
            steps: plan.operators.len(),
            cost,
            distance: removed + distance.added,
            removed,
            added: distance.added,
            moved: distance.moved,
            search_ms,
            expanded: attempt.report.statistics.expanded,
        }))
    };
    let reused = figures(&repaired.reused, reused_ms)?;
    let scratch = repaired.fresh.as_ref().map_or(Ok(None), |fresh| figures(fresh, fresh_ms))?;
    let scratch_limit = repaired.fresh.as_ref().and_then(|fresh| match fresh.report.outcome {
        Outcome::LimitReached(limit) => Some(limit_words(limit)),
        _ => None,
    });
    console.note(&match &reused {
        Some(figures) => figures.line("repaired"),
        None => format!("repaired: none, nothing could be reused within {reused_ms} ms"),
    });
    match (&scratch, scratch_limit) {
        (Some(figures), _) => console.note(&figures.line("from scratch")),
        (None, Some(limit)) => console.note(&format!("from scratch: none, {limit}, {fresh_ms} ms")),
        (None, None) if repaired.fresh.is_some() => console.note("from scratch: none"),
        (None, None) => console.note("from scratch: not looked for"),
    }
    let way = repaired.way;
    match way {
        Some(Way::Reuse) => console.note("the repaired plan is taken"),
        Some(Way::Scratch) => console.note("the plan from scratch is taken"),
        None => {}
    }
    let old_steps = old.steps.len();
    let old = old.sources[old.file].name().to_owned();
    let record = RepairRecord { old, old_steps, left_out, prefer, way, reused, scratch, scratch_limit };
    Ok((record, repaired.report()))
}

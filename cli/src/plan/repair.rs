//! `pelea plan --repair OLD_PLAN`: reuses a plan that no longer fits, and searches for a new plan to compare.
//!
//! Both plans are validated and reported: their cost, their distance from the old plan, the time and the states
//! expanded. The preference decides which plan is written.

use super::limit::limit_words;
use super::old_plan::OldPlan;
use super::prefer::Prefer;
use super::record::{Figures, RepairRecord};
use super::written::validated;
use crate::clock::{Deadline, Seconds, Stopwatch};
use crate::console::Console;
use crate::exit::Exit;
use crate::task::TaskFiles;
use planner::{Attempt, Budget, Outcome, Query, Repair, Repaired, Report, SearchConfiguration, Task, Way};
use std::time::Duration;

/// The time limit of the search for a new plan: this multiple of the time of the repair, at least this
/// long.
const PATIENCE: (f64, Duration) = (10.0, Duration::from_secs(1));

/// Repairs the old plan and searches for a new one; with the preference for speed, only if the repair fails.
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
        let (_, valid) = validated(files, task, plan, console)?;
        let removed = distance.removed + left_out.len();
        Ok(Some(Figures {
            steps: plan.operators.len(),
            cost: valid.cost(),
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
    let old_steps = old.length();
    let old = old.name().to_owned();
    let record = RepairRecord { old, old_steps, left_out, prefer, way, reused, scratch, scratch_limit };
    Ok((record, repaired.report()))
}

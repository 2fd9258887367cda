//! Several engines for one question, one after the other or side by side.

use super::{Budget, Engine, Limit, Outcome, Query, Report, Statistics, run};
use crate::task::Task;
use std::sync::atomic::{AtomicBool, Ordering};

/// Each stage within its share of expansions; the last one with what is left of the budget. An
/// answer of any stage is the answer.
pub(crate) fn sequence(
    task: &Task,
    query: &Query<'_>,
    stages: &[(Engine, Option<u64>)],
    budget: &Budget<'_>,
) -> Report {
    let mut statistics = Statistics::default();
    let mut outcome = Outcome::LimitReached(Limit::Incomplete);
    for &(engine, share) in stages {
        let left = budget.expansions.map(|e| e.saturating_sub(statistics.expanded));
        let expansions = match (left, share) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        let report = run(task, query, engine, &Budget { expansions, ..*budget });
        statistics += report.statistics;
        outcome = report.outcome;
        match outcome {
            Outcome::LimitReached(Limit::Incomplete | Limit::Memory) => {}
            Outcome::LimitReached(Limit::Expansions) if left.is_none_or(|l| l > 0) => {}
            _ => break,
        }
    }
    Report { outcome, statistics }
}

/// All at once, a thread each, the memory shared equally; the first answer stops the others. Which
/// one that is depends on the machine, so this is for the command line, not for replay.
pub(crate) fn parallel(task: &Task, query: &Query<'_>, engines: &[Engine], budget: &Budget<'_>) -> Report {
    let answered = AtomicBool::new(false);
    let interrupted = || answered.load(Ordering::Relaxed) || (budget.interrupted)();
    let memory_bytes = budget.memory_bytes.map(|m| m / engines.len().max(1));
    let share = Budget { memory_bytes, interrupted: &interrupted, ..*budget };
    let work = &|engine: Engine| {
        let report = run(task, query, engine, &share);
        if !matches!(report.outcome, Outcome::LimitReached(_)) {
            answered.store(true, Ordering::Relaxed);
        }
        report
    };
    let reports: Vec<Report> = std::thread::scope(|scope| {
        let handles: Vec<_> = engines.iter().map(|&e| scope.spawn(move || (work)(e))).collect();
        handles.into_iter().filter_map(|h| h.join().ok()).collect()
    });
    let mut statistics = Statistics::default();
    let mut best: Option<Outcome> = None;
    for report in reports {
        statistics += report.statistics;
        let better = match (&best, &report.outcome) {
            (None, _) => true,
            (Some(Outcome::Solved(old)), Outcome::Solved(new)) => new.cost < old.cost,
            (Some(Outcome::LimitReached(old)), Outcome::LimitReached(_)) => *old == Limit::Incomplete,
            (Some(Outcome::LimitReached(_)), _) => true,
            _ => false,
        };
        if better {
            best = Some(report.outcome);
        }
    }
    Report { outcome: best.unwrap_or(Outcome::LimitReached(Limit::Incomplete)), statistics }
}

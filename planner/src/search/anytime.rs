//! Anytime search: keeps improving the plan while the budget lasts.
//!
//! Idea: the cost of the best plan bounds every later search. First remove the steps that the plan
//! does not need (`elimination`). Then run greedy search that counts costs, and weighted A* with
//! decreasing weights; each search starts afresh with the current bound. If the last search
//! exhausts the states below the bound, the plan is optimal. Meanwhile `windows` makes parts of the
//! best plan cheaper, on a second thread unless the configuration is deterministic.
//!
//! Source: Richter & Westphal, "The LAMA planner", JAIR 2010, §6; restarts: Richter, Thayer & Ruml, "The
//! joy of forgetting: faster anytime search via restarting", ICAPS 2010.

use super::configuration::{LAMA, SearchConfiguration};
use super::elimination::without_needless;
use super::engine::Engine;
use super::outcome::{Outcome, Plan, Report};
use super::portfolio::{self, Alarm, Sink, Threads};
use super::solve::solve;
use super::windows::Windows;
use crate::heuristics::Bound;
use crate::query::{Limit, Query, SearchMeter};
use crate::task::Task;
use budget::Budget;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};

/// What is known about the quality of the last plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// No plan is cheaper.
    Optimal,
    /// There may be cheaper plans; this limit ended the search.
    Unproven(Limit),
}

/// The result of [`improve`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Improved {
    /// The best plan, or why no plan was found.
    pub report: Report,
    /// The quality of the plan, if one was found.
    pub quality: Quality,
}

/// Searches for a plan with `configuration`, then for cheaper ones until the budget is used up or
/// the plan is proven optimal. Calls `on_plan` with each plan when it is found; each plan is
/// cheaper than all before. The calls never overlap, but may come from any thread. To stop the
/// search, `on_plan` can set what the budget's `interrupted` reads.
pub fn improve(
    task: &Task,
    query: &Query<'_>,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
    on_plan: &mut (dyn FnMut(&Plan) + Send),
) -> Improved {
    let mut report = solve(task, query, configuration, budget);
    let Outcome::Solved(first) = &report.outcome else {
        return Improved { report, quality: Quality::Unproven(Limit::Incomplete) };
    };
    on_plan(first);
    if !task.has_additive_costs() {
        return improve_metric(task, query, report, budget, on_plan);
    }
    if configuration.optimal {
        return Improved { report, quality: Quality::Optimal };
    }
    let bound = Bound::none();
    bound.lower(first.cost);
    let best = Mutex::new(Best { plan: first.clone(), on_plan });
    let offer = |plan: &Plan| {
        let mut best = best.lock().unwrap_or_else(PoisonError::into_inner);
        if plan.cost < best.plan.cost {
            best.plan = plan.clone();
            bound.lower(plan.cost);
            (best.on_plan)(plan);
        }
        best.plan.clone()
    };
    let work = budget.work.map(|e| e.saturating_sub(report.statistics.expanded));
    let over = AtomicBool::new(false);
    let interrupted = || over.load(Relaxed) || (budget.interrupted)();
    // The searches below the bound get most of the memory, because windows are small.
    let rest = Budget { work, memory_bytes: budget.memory_bytes.map(|m| m / 8 * 7), ..*budget };
    let small =
        Budget { work: None, memory_bytes: budget.memory_bytes.map(|m| m / 8), interrupted: &interrupted };
    let (barred, meter) = (query.barred(task), SearchMeter::new(small));
    let polish = |most| {
        Windows { task, query: *query, barred: &barred, meter: &meter, most }
            .run(offer(&Plan { operators: Vec::new(), cost: u64::MAX }), &mut |plan| offer(&plan))
    };
    let search = || {
        let mut better = |plan: &Plan| drop(offer(&without_needless(task, query, plan, budget.interrupted)));
        let sink = Sink::Better(&mut better);
        portfolio::run(task, query, &[(Engine::Improving, 1)], Threads::One, &bound, &rest, sink)
    };
    let (polished, more) = if configuration.deterministic {
        let polished = polish(POLISH);
        (polished, search())
    } else {
        std::thread::scope(|scope| {
            let other = scope.spawn(|| polish(u64::MAX));
            let _alarm = Alarm(&over);
            let more = search();
            // Stop the windows if the plan is proven optimal or the search was interrupted. If the
            // search has merely run out of memory or of states, let the windows continue.
            let ended = [Limit::Memory, Limit::Incomplete].map(Outcome::LimitReached);
            over.store(!ended.contains(&more.outcome), Relaxed);
            (other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)), more)
        })
    };
    report.statistics += polished;
    let quality = match more.outcome {
        Outcome::Unsolvable(_) if query.state.is_exact() => Quality::Optimal,
        Outcome::Unsolvable(_) | Outcome::Unsupported(_) => Quality::Unproven(Limit::Incomplete),
        Outcome::LimitReached(limit) => Quality::Unproven(limit),
        Outcome::Solved(_) => Quality::Unproven(Limit::Incomplete),
    };
    report.statistics += more.statistics;
    let best = best.into_inner().unwrap_or_else(PoisonError::into_inner);
    report.outcome = Outcome::Solved(best.plan);
    Improved { report, quality }
}

/// Improves a metric that is not a sum of costs. No cost bound prunes such a search, so several
/// kinds of search continue past the plans that they find, and each plan with a better metric value
/// is passed on. Nothing is proven.
fn improve_metric(
    task: &Task,
    query: &Query<'_>,
    mut report: Report,
    budget: &Budget<'_>,
    on_plan: &mut (dyn FnMut(&Plan) + Send),
) -> Improved {
    const ENGINES: &[(Engine, u32)] = &[(Engine::Measured, 1), (Engine::Improving, 1), (LAMA, 1)];
    let Outcome::Solved(first) = &report.outcome else {
        return Improved { report, quality: Quality::Unproven(Limit::Incomplete) };
    };
    let mut best = (task.quality(query.state, &first.operators), first.clone());
    let bound = Bound::none();
    let work = budget.work.map(|e| e.saturating_sub(report.statistics.expanded));
    let rest = Budget { work, ..*budget };
    let mut better = |plan: &Plan| {
        let quality = task.quality(query.state, &plan.operators);
        if quality.is_some_and(|new| best.0.is_none_or(|old| new.is_below(old))) {
            best = (quality, plan.clone());
            on_plan(plan);
        }
    };
    let sink = Sink::Every(&mut better);
    let more = portfolio::run(task, query, ENGINES, Threads::One, &bound, &rest, sink);
    let quality = match more.outcome {
        Outcome::LimitReached(limit) => Quality::Unproven(limit),
        _ => Quality::Unproven(Limit::Incomplete),
    };
    report.statistics += more.statistics;
    report.outcome = Outcome::Solved(best.1);
    Improved { report, quality }
}

/// The work spent on windows if there is only one thread.
const POLISH: u64 = 1 << 27;

/// The best plan so far, and the callback for better ones.
struct Best<'p> {
    plan: Plan,
    on_plan: &'p mut (dyn FnMut(&Plan) + Send),
}

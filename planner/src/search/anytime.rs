//! Plans that get better while there is time.
//!
//! Idea: once there is a plan, its cost is a bound for all that follows. Steps that the plan can do
//! without are taken out; then greedy search that counts costs, and weighted A* with falling weights,
//! each started afresh with the bound of the last. When the last of them has nothing left below the
//! bound, the plan is optimal. Meanwhile windows of the best plan are made cheaper, on a thread of their
//! own unless the same call has to give the same answer.
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

/// How good the last plan is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quality {
    /// No plan is cheaper.
    Optimal,
    /// There may be cheaper plans: this limit ended the work.
    Unproven(Limit),
}

/// What improving came to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Improved {
    /// The best plan, or why no plan was found.
    pub report: Report,
    /// What is known about the plan, where there is one.
    pub quality: Quality,
}

/// Looks for a plan by `configuration`, then for better ones until the budget is used up or the plan is
/// known to be optimal. Each plan is handed to `on_plan` when it is found, each cheaper than those
/// before; the calls come one after the other, from any thread. The closure can end the work
/// through the budget's `interrupted`.
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
    // The searches below the bound have most of the memory: windows are small.
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
            // What is proven to be the best cannot be polished; what was interrupted may not be. Where
            // the searches are merely at their end, windows go on.
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

/// Improves a metric that is no sum of costs: no bound holds, so searches of several kinds go on past
/// the plans that they find, and each plan that measures better is handed on. Nothing is proven.
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

/// Work on windows where there is only one thread.
const POLISH: u64 = 1 << 27;

/// The best plan so far, and the callback for better ones.
struct Best<'p> {
    plan: Plan,
    on_plan: &'p mut (dyn FnMut(&Plan) + Send),
}

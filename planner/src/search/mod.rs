//! Forward search: one call, configured by name.
//!
//! [`solve`] takes a grounded task and a [`Query`] (from which state, to which goal, without which
//! operators), a [`SearchConfiguration`] and a [`Budget`]; [`improve`] goes on to better plans. Nothing is
//! global, nothing reads a clock; with a configuration of one thread the same call gives the same answer.

mod anytime;
mod bfws;
mod chance;
mod configuration;
mod distance;
mod dual_bfws;
mod eager;
mod edges;
mod elimination;
mod hill_climbing;
mod job;
mod lazy;
mod measured;
mod meter;
mod novelty;
mod open_list;
mod outcome;
mod portfolio;
mod query;
mod registry;
mod regression;
mod reordering;
mod repair;
mod searcher;
mod space;
mod type_list;
mod windows;

pub use anytime::{Improved, Quality, improve};
pub use bfws::{BfwsSettings, Count, Width};
pub use configuration::{Engine, Order, SearchConfiguration};
pub use distance::Distance;
pub use eager::EagerSettings;
pub(crate) use job::{Bound, Job, Shared};
pub use lazy::{Exploration, LazySettings, Pruning};
pub(crate) use meter::{SearchMeter, Turn};
pub use outcome::{Limit, Outcome, Plan, Report, Statistics, UnsolvableReason};
pub use portfolio::Threads;
pub(crate) use query::Barred;
pub use query::Query;
pub(crate) use registry::StateRegistry;
pub use repair::{Attempt, Preference, Repair, Repaired, Way, repair};
pub(crate) use searcher::Searcher;

use crate::ground::Feature;
use crate::heuristics::{Combine, Costs, Explorer};
use crate::task::{Impossible, Task};
use budget::Budget;
use portfolio::Sink;

/// Looks for a plan.
pub fn solve(
    task: &Task,
    query: &Query<'_>,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
) -> Report {
    if configuration.optimal && !task.has_additive_costs() {
        let outcome = Outcome::Unsupported(Feature::OptimalMetric);
        return Report { outcome, statistics: Statistics::default() };
    }
    if let Some(reason) = &query.goal.impossible {
        return Report::unsolvable(UnsolvableReason::Impossible(reason.clone()));
    }
    if query.state.is_exact()
        && let Some(reason) = relaxed_unreachable(task, query, budget)
    {
        return Report::unsolvable(reason);
    }
    let SearchConfiguration { members, threads, .. } = *configuration;
    let mut report = portfolio::run(task, query, members, threads, &Bound::none(), budget, Sink::First);
    if !query.state.is_exact() && matches!(report.outcome, Outcome::Unsolvable(_)) {
        report.outcome = Outcome::LimitReached(Limit::Incomplete);
    }
    if let Outcome::Solved(plan) = &mut report.outcome
        && !configuration.optimal
    {
        *plan = elimination::without_needless(task, query, plan, budget.interrupted);
    }
    report
}

/// The literals of the goal that even the delete relaxation cannot reach.
fn relaxed_unreachable(task: &Task, query: &Query<'_>, budget: &Budget<'_>) -> Option<UnsolvableReason> {
    let (barred, meter) = (query.barred(task), SearchMeter::new(*budget));
    let (bound, shared) = (Bound::none(), Shared::default());
    let (state, goal) = (query.state, query.goal);
    let job = Job { task, state, goal, barred: &barred, meter: &meter, bound: &bound, shared: &shared };
    let goal = task.relaxation.literals(&query.goal.literals);
    let mut explorer = Explorer::new(&job, Vec::new(), Costs::Unit, Combine::Max);
    explorer.explore(query.state.words());
    if meter.is_stopped() {
        return None;
    }
    let missing = goal.into_iter().filter(|&p| explorer.cost(p) == u32::MAX);
    let (mut atoms, mut negated) = (Vec::new(), Vec::new());
    for p in missing {
        let (fact, positive) = task.relaxation.literal(p);
        (if positive { &mut atoms } else { &mut negated }).push(fact);
    }
    if atoms.is_empty() && negated.is_empty() {
        return None;
    }
    let named = |facts: &[crate::ids::FactId]| -> Option<Vec<_>> {
        facts.iter().map(|&f| task.facts()[f].atom.clone()).collect()
    };
    let list = if atoms.is_empty() { named(&negated) } else { named(&atoms) };
    Some(UnsolvableReason::Impossible(match list {
        None => Impossible::Formula,
        Some(list) if atoms.is_empty() => Impossible::NegatedAtoms(list),
        Some(list) => Impossible::Atoms(list),
    }))
}

//! Answers one query with one configuration.

use super::configuration::SearchConfiguration;
use super::elimination;
use super::outcome::{Outcome, Report, Statistics, UnsolvableReason};
use super::portfolio::{self, Sink};
use crate::ground::Feature;
use crate::heuristics::{Bound, Combine, Costs, Explorer, Job, Shared};
use crate::query::{Limit, Query, SearchMeter};
use crate::task::{Impossible, Task};
use budget::Budget;

/// Searches for a plan.
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

/// The literals of the goal that are unreachable even in the delete relaxation.
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

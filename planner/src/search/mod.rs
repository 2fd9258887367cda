//! Forward search: one call, configured by name.
//!
//! [`solve`] takes a grounded task and a [`Query`] (from which state, to which goal, without which
//! operators), a [`SearchConfiguration`] and a [`Budget`]. Nothing is global, nothing reads a clock;
//! with a configuration of one thread the same call gives the same answer.

mod astar;
mod bfws;
mod budget;
mod configuration;
mod lazy;
mod open_list;
mod outcome;
mod portfolio;
mod query;
mod registry;

pub use bfws::Width;
pub use budget::{Budget, Limit};
pub use configuration::{Engine, SearchConfiguration};
pub use outcome::{Outcome, Plan, Report, Statistics, UnsolvableReason};
pub(crate) use query::Barred;
pub use query::Query;

use crate::heuristics::{Combine, Costs, Explorer};
use crate::task::{Impossible, Task};

/// Looks for a plan.
pub fn solve(
    task: &Task,
    query: &Query<'_>,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
) -> Report {
    if let Some(reason) = &query.goal.impossible {
        return Report::unsolvable(UnsolvableReason::Impossible(reason.clone()));
    }
    if let Some(reason) = relaxed_unreachable(task, query) {
        return Report::unsolvable(reason);
    }
    run(task, query, configuration.engine, budget)
}

fn run(task: &Task, query: &Query<'_>, engine: Engine, budget: &Budget<'_>) -> Report {
    match engine {
        Engine::Lazy { heuristics, costs } => lazy::search(task, query, heuristics, costs, budget),
        Engine::AStar(heuristic) => astar::search(task, query, heuristic, budget),
        Engine::Bfws(width) => bfws::search(task, query, width, budget),
        Engine::Sequence(stages) => portfolio::sequence(task, query, stages, budget),
        Engine::Parallel(engines) => portfolio::parallel(task, query, engines, budget),
    }
}

/// The literals of the goal that even the delete relaxation cannot reach.
fn relaxed_unreachable(task: &Task, query: &Query<'_>) -> Option<UnsolvableReason> {
    let barred = query.barred(task);
    let goal = task.relaxation.literals(&query.goal.literals);
    let mut explorer = Explorer::new(task, Vec::new(), &barred, Costs::Unit, Combine::Max);
    explorer.explore(query.state.words());
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

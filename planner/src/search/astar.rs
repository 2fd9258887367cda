//! A*: optimal plans with an admissible heuristic.
//!
//! States are reopened when a cheaper way is found, so consistency is not required. Ties on `f` go
//! to the smaller estimate.
//!
//! Source: Hart, Nilsson & Raphael, "A formal basis for the heuristic determination of minimum cost
//! paths", 1968.

use super::registry::StateRegistry;
use super::{Budget, Outcome, Plan, Query, Report, Statistics, UnsolvableReason};
use crate::heuristics::{Costs, Estimate, HeuristicKind};
use crate::ids::StateId;
use crate::task::Task;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Cost of the best known way, and the estimate once it is known.
struct Node {
    g: u64,
    h: Option<Estimate>,
}

/// In the order of expansion: f, h, order of insertion, g, state.
type Entry = (u64, u32, u64, u64, u32);

/// Runs the search.
pub(crate) fn search(task: &Task, query: &Query<'_>, kind: HeuristicKind, budget: &Budget<'_>) -> Report {
    let mut statistics = Statistics::default();
    let outcome = run(task, query, kind, budget, &mut statistics);
    Report { outcome, statistics }
}

fn run(
    task: &Task,
    query: &Query<'_>,
    kind: HeuristicKind,
    budget: &Budget<'_>,
    statistics: &mut Statistics,
) -> Outcome {
    let barred = query.barred(task);
    let mut heuristic = kind.build(task, query.state, query.goal, &barred, Costs::Real);
    let mut registry = StateRegistry::new(task.words_per_state());
    let mut nodes: Vec<Node> = Vec::new();
    let mut open: BinaryHeap<Reverse<Entry>> = BinaryHeap::new();
    let mut order = 0;
    let (mut successors, mut ignored) = (Vec::new(), Vec::new());
    let mut next = query.state.words().to_vec();
    let mut here = next.clone();

    let (start, _) = registry.insert(&next, None);
    heuristic.start(start, &next);
    statistics.evaluated += 1;
    let h = heuristic.estimate(start, &next, &[], &mut ignored);
    nodes.push(Node { g: 0, h: Some(h) });
    if h != Estimate::DEAD_END {
        open.push(Reverse((u64::from(h.0), h.0, order, 0, start.0)));
    }
    while let Some(Reverse((_, _, _, g, id))) = open.pop() {
        let id = StateId(id);
        if nodes[id.0 as usize].g < g {
            continue;
        }
        here.copy_from_slice(registry.words(id));
        if query.goal.holds_in(&here) {
            return Outcome::Solved(Plan::of(task, registry.path(id)));
        }
        let bytes = registry.memory() + nodes.len() * size_of::<Node>() + open.len() * 40;
        if let Some(limit) = budget.exceeded(statistics.expanded, bytes, 0) {
            return Outcome::LimitReached(limit);
        }
        statistics.expanded += 1;
        successors.clear();
        task.successors.applicable(&here, &mut successors);
        barred.filter(&mut successors);
        for &operator in &successors {
            statistics.generated += 1;
            next.copy_from_slice(&here);
            task.apply(operator, &here, &mut next);
            let cost = g + u64::from(task.operators()[operator].cost);
            let (child, new) = registry.insert(&next, Some((id, operator)));
            if new {
                nodes.push(Node { g: cost, h: None });
            } else if nodes[child.0 as usize].g <= cost {
                continue;
            } else {
                registry.reparent(child, id, operator);
            }
            let node = &mut nodes[child.0 as usize];
            node.g = cost;
            heuristic.step(id, operator, child, &next);
            let h = *node.h.get_or_insert_with(|| {
                statistics.evaluated += 1;
                ignored.clear();
                heuristic.estimate(child, &next, &[], &mut ignored)
            });
            if h != Estimate::DEAD_END {
                order += 1;
                open.push(Reverse((cost + u64::from(h.0), h.0, order, cost, child.0)));
            }
        }
    }
    Outcome::Unsolvable(UnsolvableReason::SpaceExhausted)
}

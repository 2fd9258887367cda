//! Greedy best-first search with deferred evaluation, several heuristics and preferred operators.
//!
//! Idea: a state is estimated when it is taken from an open list, and its successors are queued
//! under its own estimate, so that only states worth visiting are ever built. Each heuristic has a
//! list of all successors and one of the preferred ones; lists take turns, and the preferred ones get
//! a boost whenever some heuristic finds a new best. Complete; not optimal.
//!
//! Source: Richter & Westphal, "The LAMA planner", JAIR 2010, §3 and §5; Helmert 2006, §5.3.

use super::open_list::OpenList;
use super::registry::StateRegistry;
use super::{Barred, Budget, Limit, Outcome, Plan, Query, Report, Statistics, UnsolvableReason};
use crate::heuristics::{Costs, Estimate, Heuristic, HeuristicKind};
use crate::ids::{OperatorId, StateId};
use crate::task::Task;

/// How much a new best estimate moves the preferred lists ahead.
const BOOST: i64 = 1000;

/// A successor that is not built yet.
type Edge = (StateId, OperatorId);

struct Lists {
    open: OpenList<Edge>,
    preferred: OpenList<Edge>,
    open_priority: i64,
    preferred_priority: i64,
    best: Estimate,
}

struct Lazy<'t> {
    task: &'t Task,
    barred: Barred,
    heuristics: Vec<Box<dyn Heuristic + 't>>,
    lists: Vec<Lists>,
    registry: StateRegistry,
    statistics: Statistics,
}

/// Runs the search.
pub(crate) fn search(
    task: &Task,
    query: &Query<'_>,
    kinds: &[HeuristicKind],
    costs: Costs,
    budget: &Budget<'_>,
) -> Report {
    let barred = query.barred(task);
    let heuristics: Vec<_> =
        kinds.iter().map(|k| k.build(task, query.state, query.goal, &barred, costs)).collect();
    let list = || Lists {
        open: OpenList::new(),
        preferred: OpenList::new(),
        open_priority: 0,
        preferred_priority: 0,
        best: Estimate::DEAD_END,
    };
    let mut search = Lazy {
        task,
        barred,
        lists: heuristics.iter().map(|_| list()).collect(),
        heuristics,
        registry: StateRegistry::new(task.words_per_state()),
        statistics: Statistics::default(),
    };
    let outcome = search.run(query, budget);
    Report { outcome, statistics: search.statistics }
}

impl Lazy<'_> {
    fn run(&mut self, query: &Query<'_>, budget: &Budget<'_>) -> Outcome {
        let mut next = query.state.words().to_vec();
        let (mut current, _) = self.registry.insert(&next, None);
        for h in &mut self.heuristics {
            h.start(current, &next);
        }
        loop {
            if query.goal.holds_in(&next) {
                return Outcome::Solved(Plan::of(self.task, self.registry.path(current)));
            }
            self.visit(current, &next);
            loop {
                if let Some(limit) = budget.exceeded(self.statistics.expanded, self.memory(), 0) {
                    return Outcome::LimitReached(limit);
                }
                let Some((from, operator)) = self.pop() else {
                    return Outcome::Unsolvable(UnsolvableReason::SpaceExhausted);
                };
                let words = self.registry.words(from);
                next.copy_from_slice(words);
                self.task.apply(operator, words, &mut next);
                self.statistics.generated += 1;
                let (id, new) = self.registry.insert(&next, Some((from, operator)));
                for h in &mut self.heuristics {
                    h.step(from, operator, id, &next);
                }
                if new {
                    current = id;
                    break;
                }
            }
            if self.registry.len() >= u32::MAX as usize / 2 {
                return Outcome::LimitReached(Limit::Memory);
            }
        }
    }

    /// Estimates a state and queues its successors.
    fn visit(&mut self, id: StateId, words: &[u64]) {
        let mut successors = Vec::new();
        self.task.successors.applicable(words, &mut successors);
        self.barred.filter(&mut successors);
        let mut preferred = Vec::new();
        let mut estimates = Vec::with_capacity(self.heuristics.len());
        self.statistics.evaluated += 1;
        for h in &mut self.heuristics {
            let estimate = h.estimate(id, words, &successors, &mut preferred);
            // All our heuristics are safe: one dead end is enough.
            if estimate == Estimate::DEAD_END {
                return;
            }
            estimates.push(estimate);
        }
        let mut progress = false;
        for (list, &estimate) in self.lists.iter_mut().zip(&estimates) {
            if estimate < list.best {
                list.best = estimate;
                progress = true;
            }
        }
        if progress {
            self.lists.iter_mut().for_each(|l| l.preferred_priority -= BOOST);
        }
        self.statistics.expanded += 1;
        self.barred.filter(&mut preferred);
        preferred.sort_unstable();
        preferred.dedup();
        for (list, &Estimate(key)) in self.lists.iter_mut().zip(&estimates) {
            for &operator in &successors {
                list.open.push(u64::from(key), (id, operator));
            }
            for &operator in &preferred {
                list.preferred.push(u64::from(key), (id, operator));
            }
        }
    }

    fn pop(&mut self) -> Option<Edge> {
        let mut best: Option<(i64, usize, bool)> = None;
        for (i, list) in self.lists.iter().enumerate() {
            for (len, priority, preferred) in [
                (list.open.len(), list.open_priority, false),
                (list.preferred.len(), list.preferred_priority, true),
            ] {
                if len > 0 && best.is_none_or(|(p, ..)| priority < p) {
                    best = Some((priority, i, preferred));
                }
            }
        }
        let (_, i, preferred) = best?;
        let list = &mut self.lists[i];
        if preferred {
            list.preferred_priority += 1;
            list.preferred.pop()
        } else {
            list.open_priority += 1;
            list.open.pop()
        }
    }

    fn memory(&self) -> usize {
        let lists: usize = self.lists.iter().map(|l| l.open.memory() + l.preferred.memory()).sum();
        let heuristics: usize = self.heuristics.iter().map(|h| h.memory()).sum();
        self.registry.memory() + lists + heuristics
    }
}

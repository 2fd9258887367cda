//! Best-first width search, BFWS(f5).
//!
//! Problem: heuristics are dear, and plateaus long. Idea: prefer states that are novel, that is, make
//! some fact true that no state with the same two counters has had: open goals (`#g`), and facts of
//! a relaxed plan achieved since `#g` last fell (`#r`). The queue orders by novelty, then by open
//! goals. A relaxed plan is computed only where `#g` falls, so states are cheap. Complete unless
//! states without novelty are dropped ([`Width::One`]).
//!
//! Source: Lipovetzky & Geffner, "Best-first width search: exploration and exploitation in classical
//! planning", AAAI 2017.

use super::open_list::OpenList;
use super::registry::StateRegistry;
use super::{Barred, Budget, Limit, Outcome, Plan, Query, Report, Statistics, UnsolvableReason};
use crate::heuristics::goal_count::open_goals;
use crate::heuristics::{Costs, Estimate, Ff};
use crate::ids::{OperatorId, StateId, id32};
use crate::task::{Task, contains};
use rustc_hash::FxHashMap;

/// What happens to states that are not novel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    /// They are dropped: polynomial and incomplete.
    One,
    /// They wait behind all others.
    Any,
}

/// Facts to count since the number of open goals last fell.
struct Counter {
    facts: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Node {
    goals: u32,
    /// Which counter, and where its marks start.
    counter: u32,
    marks: u32,
    achieved: u32,
}

struct Bfws<'t> {
    task: &'t Task,
    barred: Barred,
    ff: Ff<'t>,
    registry: StateRegistry,
    nodes: Vec<Node>,
    counters: Vec<Counter>,
    marks: Vec<u64>,
    seen: FxHashMap<(u32, u32), Box<[u64]>>,
    open: OpenList<StateId>,
    width: Width,
    dropped: bool,
    statistics: Statistics,
}

/// Runs the search.
pub(crate) fn search(task: &Task, query: &Query<'_>, width: Width, budget: &Budget<'_>) -> Report {
    let barred = query.barred(task);
    let mut search = Bfws {
        task,
        ff: Ff::new(task, query.goal, &barred, Costs::Unit),
        barred,
        registry: StateRegistry::new(task.words_per_state()),
        nodes: Vec::new(),
        counters: Vec::new(),
        marks: Vec::new(),
        seen: FxHashMap::default(),
        open: OpenList::new(),
        width,
        dropped: false,
        statistics: Statistics::default(),
    };
    let outcome = search.run(query, budget);
    Report { outcome, statistics: search.statistics }
}

impl Bfws<'_> {
    fn run(&mut self, query: &Query<'_>, budget: &Budget<'_>) -> Outcome {
        let mut here = query.state.words().to_vec();
        let mut next = here.clone();
        let (start, _) = self.registry.insert(&here, None);
        if query.goal.holds_in(&here) {
            return Outcome::Solved(Plan::of(self.task, Vec::new()));
        }
        self.add(start, &here, open_goals(query.goal, &here), None);
        let mut successors = Vec::new();
        let mut calls = 0;
        while let Some(id) = self.open.pop() {
            self.statistics.expanded += 1;
            here.copy_from_slice(self.registry.words(id));
            successors.clear();
            self.task.successors.applicable(&here, &mut successors);
            self.barred.filter(&mut successors);
            for &operator in &successors {
                calls += 1;
                if let Some(limit) = budget.exceeded(self.statistics.expanded, self.memory(), calls) {
                    return Outcome::LimitReached(limit);
                }
                next.copy_from_slice(&here);
                self.task.apply(operator, &here, &mut next);
                self.statistics.generated += 1;
                let (child, new) = self.registry.insert(&next, Some((id, operator)));
                if !new {
                    continue;
                }
                let goals = open_goals(query.goal, &next);
                if goals == 0 {
                    return Outcome::Solved(Plan::of(self.task, self.registry.path(child)));
                }
                self.add(child, &next, goals, Some((id, operator)));
            }
        }
        if self.dropped {
            Outcome::LimitReached(Limit::Incomplete)
        } else {
            Outcome::Unsolvable(UnsolvableReason::SpaceExhausted)
        }
    }

    /// Counts, judges and queues a new state.
    fn add(&mut self, id: StateId, words: &[u64], goals: u32, from: Option<(StateId, OperatorId)>) {
        self.statistics.evaluated += 1;
        let parent = from.map(|(s, _)| self.nodes[s.0 as usize]);
        let node = match parent {
            Some(parent) if goals >= parent.goals => self.count(words, Node { goals, ..parent }),
            _ => match self.fresh_counter(words, goals) {
                Some(node) => node,
                None => {
                    // A dead end: known, never expanded.
                    self.nodes.push(Node { goals, counter: 0, marks: 0, achieved: 0 });
                    return;
                }
            },
        };
        self.nodes.push(node);
        let novel = self.is_novel(words, node);
        if !novel && self.width == Width::One {
            self.dropped = true;
            return;
        }
        self.open.push(u64::from(!novel) << 32 | u64::from(goals), id);
    }

    fn fresh_counter(&mut self, words: &[u64], goals: u32) -> Option<Node> {
        let mut preferred = Vec::new();
        if self.ff.relaxed_plan(words, &mut preferred) == Estimate::DEAD_END {
            return None;
        }
        let facts = self.task.facts().len();
        let mut achieved: Vec<u32> =
            self.ff.achieved().iter().copied().filter(|&p| (p as usize) < facts).collect();
        achieved.sort_unstable();
        let marks = id32(self.marks.len());
        self.marks.resize(self.marks.len() + achieved.len().div_ceil(64), 0);
        self.counters.push(Counter { facts: achieved });
        Some(Node { goals, counter: id32(self.counters.len() - 1), marks, achieved: 0 })
    }

    /// The node with what of its counter holds now marked off.
    fn count(&mut self, words: &[u64], mut node: Node) -> Node {
        let counter = &self.counters[node.counter as usize];
        let mut own = false;
        for (i, &fact) in counter.facts.iter().enumerate() {
            let (word, bit) = (i / 64, 1 << (i % 64));
            if self.marks[node.marks as usize + word] & bit != 0 || !contains(words, crate::ids::FactId(fact))
            {
                continue;
            }
            if !own {
                // The parent's marks are shared until they differ.
                own = true;
                let range = node.marks as usize..node.marks as usize + counter.facts.len().div_ceil(64);
                node.marks = id32(self.marks.len());
                self.marks.extend_from_within(range);
            }
            self.marks[node.marks as usize + word] |= bit;
            node.achieved += 1;
        }
        node
    }

    fn is_novel(&mut self, words: &[u64], node: Node) -> bool {
        let seen = self
            .seen
            .entry((node.goals, node.achieved))
            .or_insert_with(|| vec![0; words.len()].into_boxed_slice());
        let mut novel = false;
        for (seen, &word) in seen.iter_mut().zip(words) {
            novel |= word & !*seen != 0;
            *seen |= word;
        }
        novel
    }

    fn memory(&self) -> usize {
        self.registry.memory()
            + self.nodes.len() * size_of::<Node>()
            + self.marks.len() * 8
            + self.open.memory()
            + self.seen.len() * (self.task.words_per_state() * 8 + 32)
    }
}

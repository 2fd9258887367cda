//! Best-first width search, BFWS(f5).
//!
//! Problem: heuristics are expensive, and plateaus are large. Idea: prefer novel states. A state is
//! novel if it holds a fact (or a pair of facts) that no earlier state with the same two counters
//! has held. The counters are the number of open goals (`#g`) and the number of facts of a relaxed
//! plan that were achieved since `#g` last decreased (`#r`). The queue orders states by novelty,
//! then by open goals. A relaxed plan is computed only where `#g` decreases, so most states are
//! cheap to evaluate. Instead of open goals, `#g` can count the landmarks that are still to be
//! achieved, which also reflect goals that must be undone. The search is complete unless states
//! without novelty are dropped ([`Width::One`], [`Width::Two`]).
//!
//! Source: Lipovetzky & Geffner, "Best-first width search: exploration and exploitation in classical
//! planning", AAAI 2017; the same, "A polynomial planning algorithm that beats LAMA and FF", ICAPS 2017.

use super::novelty::{Novelty, NoveltyTable};
use super::open_list::OpenList;
use super::searcher::Stepwise;
use super::space::Space;
use super::{Job, Outcome, Statistics};
use crate::heuristics::{Costs, Estimate, Ff, Heuristic, HeuristicKind, View};
use crate::ids::{FactId, StateId, id32};
use crate::task::contains;

/// The most bytes for the table of pairs.
const PAIRS: usize = 1 << 29;

/// Which states count as novel, and what happens to the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    /// States without a new fact are dropped: polynomial and incomplete.
    One,
    /// States without a new pair of facts are dropped: polynomial and incomplete.
    Two,
    /// States without a new fact wait behind all others.
    AnyOne,
    /// States without a new pair of facts wait behind those that have one, and these wait behind
    /// those with a new fact.
    AnyTwo,
}

/// What `#g` counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Count {
    /// Goals that do not hold.
    Goals,
    /// Landmarks that are still to be achieved.
    Landmarks,
}

/// The parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BfwsSettings {
    /// The width of the novelty measure.
    pub(crate) width: Width,
    /// The count that the search tries to decrease.
    pub(crate) count: Count,
}

/// The facts that `#r` counts since `#g` last decreased.
struct Counter {
    facts: Vec<u32>,
}

#[derive(Clone, Copy)]
struct Node {
    goals: u32,
    /// The index of the counter, and where its marks start.
    counter: u32,
    marks: u32,
    achieved: u32,
    cost: u64,
}

/// The search state.
pub(crate) struct Bfws<'a> {
    space: Space<'a>,
    ff: Ff<'a>,
    count: Box<dyn Heuristic + Send + 'a>,
    nodes: Vec<Node>,
    counters: Vec<Counter>,
    counted: usize,
    marks: Vec<u64>,
    novelty: NoveltyTable,
    open: OpenList<StateId>,
    width: Width,
    begun: bool,
    dropped: bool,
}

impl<'a> Bfws<'a> {
    pub(crate) fn new(job: Job<'a>, BfwsSettings { width, count }: BfwsSettings) -> Self {
        let words = job.task.words_per_state();
        Self {
            ff: Ff::new(&job, Costs::Unit),
            count: match count {
                Count::Goals => HeuristicKind::GoalCount,
                Count::Landmarks => HeuristicKind::Landmarks,
            }
            .build(&job, Costs::Unit),
            nodes: Vec::new(),
            counters: Vec::new(),
            counted: 0,
            marks: Vec::new(),
            novelty: match width {
                Width::One | Width::AnyOne => NoveltyTable::of_facts(words),
                Width::Two | Width::AnyTwo => {
                    NoveltyTable::of_pairs(words, PAIRS.min(job.meter.whole().bytes / 4))
                }
            },
            open: OpenList::new(),
            width,
            begun: false,
            dropped: false,
            space: Space::new(job),
        }
    }

    fn begin(&mut self) -> Option<Outcome> {
        let start = self.space.root();
        self.count.start(start, &self.space.next);
        let solved = self.space.solved(start);
        if solved.is_none() {
            self.add(start, None, 0);
        }
        solved
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some(id) = self.open.pop() else {
            return Some(self.space.exhausted(self.dropped || self.space.is_bounded));
        };
        self.space.read(id);
        self.space.expand(id, self.nodes[id.0 as usize].cost);
        while let Some(child) = self.space.child() {
            if !child.is_new {
                continue;
            }
            let solved = self.space.solved(child.id);
            if solved.is_some() {
                return solved;
            }
            self.count.step(id, child.operator, child.id, &self.space.next);
            self.add(child.id, Some(id), child.cost);
        }
        None
    }

    /// Counts the state in `next`, judges its novelty and queues it.
    fn add(&mut self, id: StateId, from: Option<StateId>, cost: u64) {
        self.space.statistics.evaluated += 1;
        let estimate = self.count.estimate(&View { id, words: &self.space.next, applicable: &[] }, None);
        let goals = estimate.0;
        if estimate == Estimate::DEAD_END {
            self.nodes.push(Node { goals, counter: 0, marks: 0, achieved: 0, cost });
            return;
        }
        let parent = from.map(|s| self.nodes[s.0 as usize]);
        let node = match parent {
            Some(parent) if goals >= parent.goals => self.mark_off(Node { goals, cost, ..parent }),
            _ => match self.fresh_counter(goals, cost) {
                Some(node) => node,
                None => {
                    // A dead end: it is recorded, but never expanded.
                    self.nodes.push(Node { goals, counter: 0, marks: 0, achieved: 0, cost });
                    return;
                }
            },
        };
        self.nodes.push(node);
        let class = |node: &Node| (node.goals, node.achieved);
        let known = parent.filter(|p| class(p) == class(&node)).map(|_| self.space.here.as_slice());
        self.space.job.meter.spend(self.novelty.price(known));
        let novelty = self.novelty.judge(class(&node), &self.space.next, known);
        let rank = match (self.width, novelty) {
            (_, Novelty::One) => 0,
            (Width::Two | Width::AnyTwo, Novelty::Two) => 1,
            (Width::One | Width::Two, _) => {
                self.dropped = true;
                return;
            }
            (Width::AnyOne | Width::AnyTwo, _) => 2,
        };
        self.open.push(rank << 32 | u64::from(goals), id);
    }

    fn fresh_counter(&mut self, goals: u32, cost: u64) -> Option<Node> {
        if self.ff.relaxed_plan(&self.space.next, None) == Estimate::DEAD_END {
            return None;
        }
        let facts = self.space.job.task.facts().len();
        let mut achieved: Vec<u32> =
            self.ff.achieved().iter().copied().filter(|&p| (p as usize) < facts).collect();
        achieved.sort_unstable();
        let marks = id32(self.marks.len());
        self.marks.resize(self.marks.len() + achieved.len().div_ceil(64), 0);
        self.counted += achieved.len();
        self.counters.push(Counter { facts: achieved });
        Some(Node { goals, counter: id32(self.counters.len() - 1), marks, achieved: 0, cost })
    }

    /// Marks the facts of the node's counter that hold in `next` as achieved.
    fn mark_off(&mut self, mut node: Node) -> Node {
        let counter = &self.counters[node.counter as usize];
        let mut own = false;
        for (i, &fact) in counter.facts.iter().enumerate() {
            let (word, bit) = (i / 64, 1 << (i % 64));
            if self.marks[node.marks as usize + word] & bit != 0 || !contains(&self.space.next, FactId(fact))
            {
                continue;
            }
            if !own {
                // A node shares its parent's marks until they differ.
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
}

impl Stepwise for Bfws<'_> {
    fn job(&self) -> &Job<'_> {
        &self.space.job
    }

    fn memory(&self) -> usize {
        self.space.registry.memory()
            + self.nodes.capacity() * size_of::<Node>()
            + self.counters.capacity() * size_of::<Counter>()
            + self.counted * 4
            + self.marks.capacity() * 8
            + self.open.memory()
            + self.novelty.memory()
            + self.count.memory()
    }

    fn statistics(&self) -> Statistics {
        self.space.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if std::mem::replace(&mut self.begun, true) { self.step() } else { self.begin() }
    }
}

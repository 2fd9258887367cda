//! Dual-BFWS: a fast incomplete width search, then a complete best-first width search.
//!
//! Problem: most tasks are easy for a search that keeps only novel states and estimates almost
//! nothing; the others need an estimate for every state. Idea: the front end is 1-BFWS, which ends
//! soon with or without a plan. The back end keeps all states. It orders them by novelty of facts
//! and pairs, measured within classes of equal `h_L` (landmarks still to be achieved) and of equal
//! `h_FF` (relaxed plans); then by `h_L`, by novelty in the classes of `h_FF` alone, and by `h_FF`.
//! Among equally novel states, those reached by a helpful operator come first. Only these get a
//! relaxed plan when they are generated; the others inherit their parent's estimate until they are
//! expanded. The search is complete.
//!
//! Source: Lipovetzky & Geffner, "Best-first width search: exploration and exploitation in
//! classical planning", AAAI 2017, § Dual-BFWS. The paper uses one novelty measure over both
//! estimates; we sum the two novelties, as the authors' own implementation does.

use super::bfws::{Bfws, BfwsSettings, Count, Width};
use super::novelty::NoveltyTable;
use super::open_list::OpenList;
use super::searcher::Stepwise;
use super::space::Space;
use super::{Job, Limit, Outcome, Searcher, Statistics, Turn};
use crate::heuristics::{Costs, Estimate, Ff, Heuristic, HeuristicKind, View};
use crate::ids::{OperatorId, StateId, id32};

/// The most bytes for the pairs of facts of one table.
const PAIRS: usize = 1 << 28;

/// Runs the front end, then the back end.
pub(crate) struct DualBfws<'a> {
    job: Job<'a>,
    /// `None` once it has given up.
    front: Option<Box<Bfws<'a>>>,
    back: Option<Box<BackEnd<'a>>>,
    before: Statistics,
}

impl<'a> DualBfws<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        let front = Bfws::new(job, BfwsSettings { width: Width::One, count: Count::Goals });
        Self { job, front: Some(Box::new(front)), back: None, before: Statistics::default() }
    }
}

impl Searcher for DualBfws<'_> {
    fn advance(&mut self, turn: &Turn) -> Option<Outcome> {
        if let Some(front) = &mut self.front {
            match front.advance(turn)? {
                Outcome::LimitReached(Limit::Incomplete) => {
                    self.before = Stepwise::statistics(front.as_ref());
                    self.front = None;
                }
                answer => return Some(answer),
            }
        }
        let expansions = turn.expansions.saturating_sub(self.before.expanded);
        let back = self.back.get_or_insert_with(|| Box::new(BackEnd::new(self.job)));
        back.advance(&Turn { expansions, ..*turn })
    }

    fn statistics(&self) -> Statistics {
        let front = self.front.as_ref().map(|s| Stepwise::statistics(s.as_ref()));
        let back = self.back.as_ref().map(|s| Stepwise::statistics(s.as_ref()));
        [front, back].into_iter().flatten().fold(self.before, |sum, s| sum + s)
    }
}

#[derive(Clone, Copy)]
struct Node {
    landmarks: u32,
    /// The state's own estimate, or its parent's.
    ff: u32,
    /// The range of its helpful operators, if the estimate is its own.
    helpful: Option<(u32, u32)>,
    cost: u64,
}

/// The complete back end.
pub(crate) struct BackEnd<'a> {
    space: Space<'a>,
    ff: Ff<'a>,
    landmarks: Box<dyn Heuristic + Send + 'a>,
    nodes: Vec<Node>,
    /// The helpful operators of all nodes that have their own estimate.
    helpful: Vec<OperatorId>,
    by_landmarks: NoveltyTable,
    by_ff: NoveltyTable,
    open: OpenList<StateId>,
    begun: bool,
    preferred: Vec<OperatorId>,
}

impl<'a> BackEnd<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        let words = job.task.words_per_state();
        let pairs = PAIRS.min(job.meter.whole().bytes / 8);
        Self {
            ff: Ff::new(&job, Costs::Unit),
            landmarks: HeuristicKind::Landmarks.build(&job, Costs::Unit),
            nodes: Vec::new(),
            helpful: Vec::new(),
            by_landmarks: NoveltyTable::of_pairs(words, pairs),
            by_ff: NoveltyTable::of_pairs(words, pairs),
            open: OpenList::new(),
            begun: false,
            preferred: Vec::new(),
            space: Space::new(job),
        }
    }

    fn begin(&mut self) -> Option<Outcome> {
        let start = self.space.root();
        self.landmarks.start(start, &self.space.next);
        let solved = self.space.solved(start);
        if solved.is_none() {
            self.add(start, None, true, 0);
        }
        solved
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some(id) = self.open.pop() else { return Some(self.space.exhausted(self.space.is_bounded)) };
        self.space.read(id);
        let (from, to) = self.helpful_of(id)?;
        self.space.expand(id, self.nodes[id.0 as usize].cost);
        while let Some(child) = self.space.child() {
            if !child.is_new {
                continue;
            }
            let solved = self.space.solved(child.id);
            if solved.is_some() {
                return solved;
            }
            self.landmarks.step(id, child.operator, child.id, &self.space.next);
            let helpful = &self.helpful[from as usize..to as usize];
            let is_helpful = helpful.binary_search(&child.operator).is_ok();
            self.add(child.id, Some(id), is_helpful, child.cost);
        }
        None
    }

    /// The helpful operators of the state in `here`. Estimates the state if that was not done
    /// before; `None` for a dead end.
    fn helpful_of(&mut self, id: StateId) -> Option<(u32, u32)> {
        let node = self.nodes[id.0 as usize];
        if node.helpful.is_some() {
            return node.helpful;
        }
        self.space.statistics.evaluated += 1;
        self.preferred.clear();
        let estimate = self.ff.relaxed_plan(&self.space.here, Some(&mut self.preferred));
        if estimate == Estimate::DEAD_END {
            return None;
        }
        if estimate.0 != node.ff {
            self.space.job.meter.spend(self.by_ff.price(None));
            self.by_ff.judge((estimate.0, 0), &self.space.here, None);
        }
        let helpful = self.keep_helpful();
        self.nodes[id.0 as usize] = Node { ff: estimate.0, helpful: Some(helpful), ..node };
        Some(helpful)
    }

    fn keep_helpful(&mut self) -> (u32, u32) {
        self.preferred.sort_unstable();
        self.preferred.dedup();
        let from = id32(self.helpful.len());
        self.helpful.extend_from_slice(&self.preferred);
        (from, id32(self.helpful.len()))
    }

    /// Estimates the new state in `next`, judges its novelty and queues it. `here` holds its
    /// parent.
    fn add(&mut self, id: StateId, from: Option<StateId>, is_helpful: bool, cost: u64) {
        let landmarks = self.landmarks.estimate(&View { id, words: &self.space.next, applicable: &[] }, None);
        let parent = from.map(|s| self.nodes[s.0 as usize]);
        let mut node = Node { landmarks: landmarks.0, ff: parent.map_or(0, |p| p.ff), helpful: None, cost };
        let mut is_dead = landmarks == Estimate::DEAD_END;
        if is_helpful && !is_dead {
            self.space.statistics.evaluated += 1;
            self.preferred.clear();
            let estimate = self.ff.relaxed_plan(&self.space.next, Some(&mut self.preferred));
            is_dead = estimate == Estimate::DEAD_END;
            node.ff = estimate.0;
            node.helpful = Some(self.keep_helpful());
        }
        self.nodes.push(node);
        if is_dead {
            return;
        }
        let here = Some(self.space.here.as_slice());
        let from = parent.filter(|p| p.landmarks == node.landmarks).and(here);
        self.space.job.meter.spend(self.by_landmarks.price(from));
        let in_landmarks = self.by_landmarks.judge((node.landmarks, 0), &self.space.next, from) as u64;
        let from = parent.filter(|p| p.ff == node.ff).and(here);
        self.space.job.meter.spend(self.by_ff.price(from));
        let in_ff = self.by_ff.judge((node.ff, 0), &self.space.next, from) as u64;
        let other = u64::from(!is_helpful);
        let first = 2 * (in_landmarks + in_ff) + other;
        let third = 2 * in_ff + other;
        let landmarks = u64::from(node.landmarks.min((1 << 28) - 1));
        let ff = u64::from(node.ff.min((1 << 28) - 1));
        self.open.push(first << 60 | landmarks << 31 | third << 28 | ff, id);
    }
}

impl Stepwise for BackEnd<'_> {
    fn job(&self) -> &Job<'_> {
        &self.space.job
    }

    fn memory(&self) -> usize {
        self.space.registry.memory()
            + self.nodes.capacity() * size_of::<Node>()
            + self.helpful.capacity() * 4
            + self.open.memory()
            + self.by_landmarks.memory()
            + self.by_ff.memory()
            + self.landmarks.memory()
    }

    fn statistics(&self) -> Statistics {
        self.space.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if std::mem::replace(&mut self.begun, true) { self.step() } else { self.begin() }
    }
}

//! Best-first search with deferred evaluation, several heuristics and preferred operators.
//!
//! Idea: a state is estimated when it is taken from an open list, and its successors are queued
//! under its estimate, so only states that are visited are ever generated. Each heuristic has an
//! open list of all successors and one of the preferred successors. The lists take turns, and the
//! preferred lists get a boost whenever some heuristic finds a new best estimate. Without a new
//! best estimate for a while, the lists for exploration get turns too. The order is greedy, or
//! weighted A* that reopens a state when a cheaper path is found. The search is complete, but not
//! optimal.
//!
//! Source: Richter & Westphal, "The LAMA planner", JAIR 2010, §3 and §5; Helmert 2006, §5.3;
//! novelty with respect to estimates: Katz, Lipovetzky, Moshkovich & Tuisov, "Adapting novelty to
//! classical planning as heuristic search", ICAPS 2017 (they sort the open list by novelty, we give
//! it a list of its own).

use super::edges::{Arena, Edge, Run};
use super::novelty::{Novelty, NoveltyTable};
use super::open_list::OpenList;
use super::order::Order;
use super::registry::StateRegistry;
use super::searcher::Stepwise;
use super::type_list::TypeList;
use super::{Job, Limit, Outcome, Plan, Statistics, UnsolvableReason};
use crate::heuristics::{Costs, Estimate, Heuristic, HeuristicKind, View};
use crate::ids::{OperatorId, StateId};
use crate::query;

/// How far a new best estimate moves the preferred lists ahead.
const BOOST: i64 = 1000;

/// An extra open list that leads out of plateaus on which all estimates mislead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exploration {
    /// A random edge of a random type. A type is the depth and two estimates of the state.
    Types,
    /// Edges of novel states first: those with a fact that no state with the same estimates has
    /// held.
    Novelty,
}

/// The parameters.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LazySettings {
    /// The heuristics; each has a pair of open lists.
    pub(crate) heuristics: &'static [HeuristicKind],
    /// The heuristics whose preferred operators are tried first.
    pub(crate) preferred: &'static [HeuristicKind],
    /// Which operator costs the heuristics count.
    pub(crate) costs: Costs,
    /// The key by which the queues are sorted.
    pub(crate) order: Order,
    /// The extra lists for exploration.
    pub(crate) explorations: &'static [Exploration],
    /// Which states are pruned if there is a bound.
    pub(crate) pruning: Pruning,
}

/// Which states are pruned if a plan must cost less than a bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Pruning {
    /// States whose path alone reaches the bound: no plan below the bound is lost.
    Spent,
    /// States whose path and relaxed plan together reach the bound: plans below the bound may be
    /// lost, but few states are left, and the search ends soon.
    Estimated,
}

struct Lists<'a> {
    heuristic: Box<dyn Heuristic + Send + 'a>,
    prefers: bool,
    open: OpenList<Run>,
    preferred: OpenList<Run>,
    open_priority: i64,
    preferred_priority: i64,
    best: Estimate,
    /// The estimate of the state that is being visited.
    estimate: Estimate,
}

/// An open list that is not sorted by one estimate.
enum Queue {
    Types(TypeList<Edge>),
    Novelty(NoveltyTable, OpenList<Run>),
}

impl Queue {
    fn new(exploration: Exploration, words: usize) -> Self {
        match exploration {
            Exploration::Types => Self::Types(TypeList::new()),
            Exploration::Novelty => Self::Novelty(NoveltyTable::of_facts(words), OpenList::new()),
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Types(list) => list.len(),
            Self::Novelty(_, list) => list.len(),
        }
    }

    fn pop(&mut self, arena: &Arena) -> Option<Edge> {
        match self {
            Self::Types(list) => list.pop(),
            Self::Novelty(_, list) => arena.pop(list),
        }
    }

    fn memory(&self) -> usize {
        match self {
            Self::Types(list) => list.memory(),
            Self::Novelty(table, list) => table.memory() + list.memory(),
        }
    }
}

struct Exploring {
    queue: Queue,
    priority: i64,
}

/// The list whose turn it is.
#[derive(Clone, Copy)]
enum List {
    Open(usize),
    Preferred(usize),
    Exploring(usize),
}

/// The search state.
pub(crate) struct Lazy<'a> {
    job: Job<'a>,
    order: Order,
    pruning: Pruning,
    lists: Vec<Lists<'a>>,
    explorations: Vec<Exploring>,
    arena: Arena,
    /// The number of steps by which each state was reached; types need it.
    depths: Vec<u32>,
    registry: StateRegistry<'a>,
    /// The cost of the path by which each state was reached.
    reached_at: Vec<u64>,
    begun: bool,
    /// Whether a pruned state may have been on a plan below the bound.
    pruned: bool,
    statistics: Statistics,
    successors: Vec<OperatorId>,
    preferred: Vec<OperatorId>,
    here: Vec<u64>,
    next: Vec<u64>,
}

impl<'a> Lazy<'a> {
    pub(crate) fn new(job: Job<'a>, settings: &LazySettings) -> Self {
        let list = |kind: &HeuristicKind| Lists {
            heuristic: kind.build(&job, settings.costs),
            prefers: settings.preferred.contains(kind),
            open: OpenList::new(),
            preferred: OpenList::new(),
            open_priority: 0,
            preferred_priority: 0,
            best: Estimate::DEAD_END,
            estimate: Estimate::DEAD_END,
        };
        Self {
            lists: settings.heuristics.iter().map(list).collect(),
            explorations: settings
                .explorations
                .iter()
                .map(|&e| Exploring { queue: Queue::new(e, job.task.words_per_state()), priority: 0 })
                .collect(),
            arena: Arena::default(),
            depths: Vec::new(),
            order: settings.order,
            pruning: settings.pruning,
            registry: StateRegistry::new(job.task, job.state.words()),
            reached_at: Vec::new(),
            begun: false,
            pruned: false,
            statistics: Statistics::default(),
            successors: Vec::new(),
            preferred: Vec::new(),
            here: job.state.words().to_vec(),
            next: job.state.words().to_vec(),
            job,
        }
    }

    fn begin(&mut self) -> Option<Outcome> {
        let (start, _) = self.registry.insert(&self.next, None);
        self.reached_at.push(0);
        self.depths.push(0);
        for list in &mut self.lists {
            list.heuristic.start(start, &self.next);
        }
        self.visit(start)
    }

    /// Generates the next state of the lists. Visits it if it is new, or reached by a cheaper path.
    fn step(&mut self) -> Option<Outcome> {
        let Some((from, operator)) = self.pop() else {
            return Some(match self.pruned {
                true => Outcome::LimitReached(Limit::Incomplete),
                false => Outcome::Unsolvable(UnsolvableReason::SpaceExhausted),
            });
        };
        let task = self.job.task;
        let cost = self.reached_at[from.0 as usize] + u64::from(task.operators.cost(operator));
        if cost >= self.job.bound.get() {
            self.pruned |= self.order == Order::Greedy;
            return None;
        }
        self.registry.read(from, &mut self.here);
        self.next.copy_from_slice(&self.here);
        if !task.apply(operator, &self.here, &mut self.next) {
            self.pruned = true;
            return None;
        }
        self.statistics.generated += 1;
        self.job.meter.spend(query::price_of_state(self.next.len()));
        let (id, new) = self.registry.insert(&self.next, Some((from, operator)));
        for list in &mut self.lists {
            list.heuristic.step(from, operator, id, &self.next);
        }
        if new {
            self.reached_at.push(cost);
            self.depths.push(self.depths[from.0 as usize] + 1);
        } else {
            let known = &mut self.reached_at[id.0 as usize];
            if self.order == Order::Greedy || *known <= cost {
                return None;
            }
            *known = cost;
            self.registry.reparent(id, from, operator);
        }
        self.visit(id)
    }

    /// Tests the goal in the state in `next`, estimates it and queues its successors.
    fn visit(&mut self, id: StateId) -> Option<Outcome> {
        let task = self.job.task;
        if self.job.goal.holds_in(&self.next) {
            return Some(Outcome::Solved(Plan::of(task, self.registry.path(id))));
        }
        self.successors.clear();
        task.successors.applicable(&self.next, &mut self.successors);
        self.job.barred.filter(&mut self.successors);
        self.job.meter.spend(self.successors.len() * 16);
        self.preferred.clear();
        self.statistics.evaluated += 1;
        let view = View { id, words: &self.next, applicable: &self.successors };
        for list in &mut self.lists {
            list.estimate = list.heuristic.estimate(&view, list.prefers.then_some(&mut self.preferred));
            // All heuristics are safe, so one that reports a dead end is enough.
            if list.estimate == Estimate::DEAD_END {
                return None;
            }
        }
        let cost = self.reached_at[id.0 as usize];
        if self.pruning == Pruning::Estimated {
            let rest = self.lists.iter().map(|l| l.heuristic.rest()).max().unwrap_or(0);
            if cost.saturating_add(rest) >= self.job.bound.get() {
                self.pruned = true;
                return None;
            }
        }
        let mut progress = false;
        for list in &mut self.lists {
            progress |= list.estimate < list.best;
            list.best = list.best.min(list.estimate);
        }
        if progress {
            self.lists.iter_mut().for_each(|l| l.preferred_priority -= BOOST);
        }
        self.statistics.expanded += 1;
        self.job.barred.filter(&mut self.preferred);
        self.preferred.sort_unstable();
        self.preferred.dedup();
        self.queue(id, cost);
        None
    }

    /// Queues all successors of the state in `next` in all lists.
    fn queue(&mut self, id: StateId, cost: u64) {
        let estimate = |i: usize| self.lists.get(i).map_or(0, |l| l.estimate.0);
        let (first, second) = (estimate(0), estimate(1));
        let mut rank = 0;
        for exploring in &mut self.explorations {
            match &mut exploring.queue {
                Queue::Types(list) => {
                    let edges = self.successors.iter().map(|&operator| (id, operator));
                    list.push([first, second, self.depths[id.0 as usize]], edges);
                }
                Queue::Novelty(table, _) => {
                    self.job.meter.spend(table.price(None));
                    rank = u64::from(table.judge((first, second), &self.next, None) != Novelty::One);
                }
            }
        }
        let Self { arena, lists, explorations, order, successors, preferred, .. } = self;
        arena.keep(id, successors, |run| {
            for list in lists.iter_mut() {
                list.open.push(order.key(cost, list.estimate), run);
            }
            for exploring in explorations.iter_mut() {
                if let Queue::Novelty(_, list) = &mut exploring.queue {
                    list.push(rank << 32 | u64::from(first), run);
                }
            }
        });
        arena.keep(id, preferred, |run| {
            for list in lists.iter_mut() {
                list.preferred.push(order.key(cost, list.estimate), run);
            }
        });
    }

    fn pop(&mut self) -> Option<Edge> {
        let sorted = self.lists.iter().enumerate().flat_map(|(i, list)| {
            [
                (list.open.len(), list.open_priority, List::Open(i)),
                (list.preferred.len(), list.preferred_priority, List::Preferred(i)),
            ]
        });
        let exploring = self.explorations.iter().enumerate();
        let exploring = exploring.map(|(i, e)| (e.queue.len(), e.priority, List::Exploring(i)));
        let filled = sorted.chain(exploring).filter(|&(len, ..)| len > 0);
        match filled.min_by_key(|&(_, priority, _)| priority)?.2 {
            List::Open(i) => {
                self.lists[i].open_priority += 1;
                self.arena.pop(&mut self.lists[i].open)
            }
            List::Preferred(i) => {
                self.lists[i].preferred_priority += 1;
                self.arena.pop(&mut self.lists[i].preferred)
            }
            List::Exploring(i) => {
                self.explorations[i].priority += 1;
                self.explorations[i].queue.pop(&self.arena)
            }
        }
    }
}

impl Stepwise for Lazy<'_> {
    fn job(&self) -> &Job<'_> {
        &self.job
    }

    fn memory(&self) -> usize {
        let lists: usize =
            self.lists.iter().map(|l| l.open.memory() + l.preferred.memory() + l.heuristic.memory()).sum();
        let exploring: usize = self.explorations.iter().map(|e| e.queue.memory()).sum();
        self.registry.memory()
            + self.reached_at.capacity() * 8
            + self.depths.capacity() * 4
            + lists
            + exploring
            + self.arena.memory()
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if std::mem::replace(&mut self.begun, true) { self.step() } else { self.begin() }
    }
}

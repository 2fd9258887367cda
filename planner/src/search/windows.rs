//! Plan improvement by windows: replaces parts of a plan by cheaper ones.
//!
//! Idea: cut a window out of the plan. The needs of the later steps, regressed to the end of the
//! window, are a small goal. A cheaper path to that goal from the start of the window makes the
//! whole plan cheaper. Windows start at every part of the plan and grow, and the plan is reordered
//! so that other steps lie together (`reordering`). The first round prunes states by their relaxed
//! plan, so most windows end soon. Each later round allows more work for a window, and every other
//! round prunes by path cost only. Invariant: a plan is returned only if a replay reaches the goal
//! and the plan is cheaper. The regression ignores the needs of conditional effects and axioms; the
//! replay detects those cases.
//!
//! Source: Siddiqui & Haslum, "Continuing plan quality optimisation", JAIR 2015, §4.

use super::improving::counted;
use super::lazy::{Lazy, LazySettings, Pruning};
use super::order::Order;
use super::reordering::{Arrangement, arranged};
use super::{Barred, Bound, Job, Outcome, Plan, Query, SearchMeter, Searcher, Shared, Statistics, Turn};
use crate::heuristics::{Costs, HeuristicKind};
use crate::ids::OperatorId;
use crate::task::{Goal, Kernel, Literals, State, Task};
use rustc_hash::{FxHashSet, FxHasher};
use std::hash::{Hash, Hasher};

/// The work for a window in the first round; it doubles with each round.
const WORK: u64 = 1 << 22;
/// The number of rounds.
const ROUNDS: u32 = 12;
/// Steps in the smallest windows; the size doubles up to the whole plan.
const SMALLEST: usize = 6;

/// The plan's query and the limits of the work on windows.
pub(crate) struct Windows<'a> {
    pub(crate) task: &'a Task,
    pub(crate) query: Query<'a>,
    pub(crate) barred: &'a Barred,
    pub(crate) meter: &'a SearchMeter<'a>,
    /// The most work in all.
    pub(crate) most: u64,
}

/// The settings of the current round, and the windows tried in it.
struct Tried {
    costs: Costs,
    pruning: Pruning,
    /// The work for each window.
    work: u64,
    /// Hashes of the windows of this round: state, goal and cost.
    windows: FxHashSet<u64>,
    statistics: Statistics,
}

impl Tried {
    fn is_new(&mut self, state: &State, goal: &Literals, cost: u64) -> bool {
        let mut hasher = FxHasher::default();
        (state.words(), &goal.positive, &goal.negative, cost).hash(&mut hasher);
        self.windows.insert(hasher.finish())
    }
}

impl Windows<'_> {
    /// Makes the plan cheaper. `exchange` receives each cheaper plan and returns the cheapest plan
    /// that any search has found.
    pub(crate) fn run(&self, mut plan: Plan, exchange: &mut dyn FnMut(Plan) -> Plan) -> Statistics {
        let mut tried = Tried {
            costs: counted(self.task),
            pruning: Pruning::Estimated,
            work: WORK,
            windows: FxHashSet::default(),
            statistics: Statistics::default(),
        };
        for round in 0..ROUNDS {
            tried.work = WORK << round;
            // With more work or other pruning, every window is worth another try.
            tried.windows.clear();
            tried.pruning = if round % 2 == 0 { Pruning::Estimated } else { Pruning::Spent };
            for arrangement in [
                Arrangement::Found,
                Arrangement::Forward,
                Arrangement::Backward,
                Arrangement::Jumping(u64::from(round)),
            ] {
                plan = self.arrange(plan, arrangement);
                let mut size = SMALLEST;
                loop {
                    let mut start = 0;
                    while start < plan.operators.len() {
                        if self.is_over() {
                            return tried.statistics;
                        }
                        let end = (start + size).min(plan.operators.len());
                        match self.shorten(&plan, start, end, &mut tried) {
                            Some(better) => plan = exchange(better),
                            None => start += (size / 2).max(1),
                        }
                    }
                    if size >= plan.operators.len() {
                        break;
                    }
                    size *= 2;
                }
                plan = exchange(plan);
            }
        }
        tried.statistics
    }

    fn is_over(&self) -> bool {
        self.meter.spend(1) || self.meter.work() >= self.most
    }

    /// Returns the reordered plan if it is valid, otherwise the plan itself.
    fn arrange(&self, plan: Plan, arrangement: Arrangement) -> Plan {
        let operators = arranged(self.task, &plan.operators, arrangement);
        match self.replay(self.query.state, &operators) {
            Some(end) if self.query.goal.holds_in(end.words()) => Plan { operators, ..plan },
            _ => plan,
        }
    }

    fn shorten(&self, plan: &Plan, start: usize, end: usize, tried: &mut Tried) -> Option<Plan> {
        let task = self.task;
        let (before, rest) = plan.operators.split_at(start);
        let (window, after) = rest.split_at(end - start);
        let state = self.replay(self.query.state, before)?;
        let goal = self.needed(after);
        let cost = Plan::of(task, window.to_vec()).cost;
        if cost == 0 || !tried.is_new(&state, &goal, cost) {
            return None;
        }
        let goal = Goal::new(goal);
        let bound = Bound::none();
        bound.lower(cost);
        let (barred, meter, shared) = (self.barred, self.meter, Shared::default());
        let job = Job { task, state: &state, goal: &goal, barred, meter, bound: &bound, shared: &shared };
        const FF: &[HeuristicKind] = &[HeuristicKind::Ff];
        let settings = LazySettings {
            heuristics: FF,
            preferred: FF,
            costs: tried.costs,
            order: Order::Weighted(1),
            explorations: &[],
            pruning: tried.pruning,
        };
        let until = (meter.work() + tried.work).min(self.most);
        let mut search = Lazy::new(job, &settings);
        let outcome = search.advance(&Turn { until, ..meter.whole() });
        tried.statistics += search.statistics();
        let Some(Outcome::Solved(found)) = outcome else { return None };
        let operators = [before, &found.operators, after].concat();
        let end = self.replay(self.query.state, &operators)?;
        let better = Plan::of(task, operators);
        (self.query.goal.holds_in(end.words()) && better.cost < plan.cost).then_some(better)
    }

    fn replay(&self, from: &State, steps: &[OperatorId]) -> Option<State> {
        let mut state = from.clone();
        let mut next = from.clone();
        for &operator in steps {
            self.meter.spend(state.words().len() + 16);
            if !self.task.is_applicable(&state, operator) {
                return None;
            }
            next.words_mut().copy_from_slice(state.words());
            if !self.task.apply(operator, state.words(), next.words_mut()) {
                return None;
            }
            std::mem::swap(&mut state, &mut next);
        }
        Some(state)
    }

    /// The facts that must hold before `steps` so that they reach the goal.
    fn needed(&self, steps: &[OperatorId]) -> Literals {
        let mut kernel = Kernel::new(self.task, &self.query.goal.literals);
        for &step in steps.iter().rev() {
            let operator = self.task.operator(step);
            self.meter.spend(operator.adds.len() + operator.deletes.len() + 16);
            kernel.before(step);
        }
        kernel.literals()
    }
}

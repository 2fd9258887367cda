//! Cheaper ways between two states of a plan.
//!
//! Idea: cut a window out of the plan; what the rest of the plan needs, followed back to the window's
//! end, is a small goal, and a cheaper way to it from the window's start makes the whole plan cheaper.
//! Windows start everywhere and grow, and the plan is arranged anew, so that other steps lie together
//! (`reordering`). First, states go whose relaxed plan is too dear, and most windows end soon; when all
//! have been tried each may take longer, and in every other round those states stay. Invariant: a plan
//! is handed out only if it was replayed to the goal and costs less. What conditional effects and
//! axioms need is not followed back; the replay finds out.
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

/// Work for a window in the first round; it doubles with each.
const WORK: u64 = 1 << 22;
/// Rounds, at most.
const ROUNDS: u32 = 12;
/// Steps in the smallest windows; they double up to the whole plan.
const SMALLEST: usize = 6;

/// What windows are cut for.
pub(crate) struct Windows<'a> {
    pub(crate) task: &'a Task,
    pub(crate) query: Query<'a>,
    pub(crate) barred: &'a Barred,
    pub(crate) meter: &'a SearchMeter<'a>,
    /// Work in all, at most.
    pub(crate) most: u64,
}

/// How windows are searched now, and which have been.
struct Tried {
    costs: Costs,
    pruning: Pruning,
    /// Work for each.
    work: u64,
    /// Those of this round: from where, to what and below which cost, as hashes.
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
    /// Makes the plan cheaper. `exchange` receives each cheaper plan and returns the cheapest plan that
    /// any search has found.
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
            // With more work, or pruned otherwise, all are worth another try.
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

    /// The plan in another order, where that is a plan.
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

    /// What must hold before `steps` for them to be done and to end in the goal.
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

//! Enforced hill-climbing on relaxed plans.
//!
//! Idea: from the current state search breadth first, through operators that begin a relaxed plan,
//! until some state is estimated lower; go there and never come back. Where the helpful operators do
//! not lead lower, all are tried. Fast where plateaus are shallow and there are no dead ends;
//! incomplete otherwise.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §5.1.

use super::meter::price_of_state;
use super::registry::StateRegistry;
use super::searcher::Stepwise;
use super::{Job, Limit, Outcome, Plan, Statistics, UnsolvableReason};
use crate::heuristics::{Costs, Estimate, Ff};
use crate::ids::{OperatorId, StateId};
use std::collections::VecDeque;

/// Which operators the current breadth-first search follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Followed {
    Helpful,
    All,
}

/// The search.
pub(crate) struct HillClimbing<'a> {
    job: Job<'a>,
    ff: Ff<'a>,
    /// The steps to the state from which the current breadth-first search starts.
    steps: Vec<OperatorId>,
    base: Vec<u64>,
    height: Estimate,
    followed: Followed,
    registry: StateRegistry<'a>,
    queue: VecDeque<(StateId, Vec<OperatorId>)>,
    begun: bool,
    /// Whether a successor was left out whose numbers do not fit.
    pruned: bool,
    statistics: Statistics,
    next: Vec<u64>,
}

impl<'a> HillClimbing<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        Self {
            ff: Ff::new(&job, Costs::Unit),
            steps: Vec::new(),
            base: job.state.words().to_vec(),
            height: Estimate::DEAD_END,
            followed: Followed::Helpful,
            registry: StateRegistry::new(job.task, job.state.words()),
            queue: VecDeque::new(),
            begun: false,
            pruned: false,
            statistics: Statistics::default(),
            next: job.state.words().to_vec(),
            job,
        }
    }

    /// Starts a breadth-first search at `base`.
    fn plateau(&mut self, followed: Followed, helpful: Vec<OperatorId>) {
        self.followed = followed;
        self.registry = StateRegistry::new(self.job.task, &self.base);
        self.queue.clear();
        let (id, _) = self.registry.insert(&self.base, None);
        self.queue.push_back((id, helpful));
    }

    fn begin(&mut self) -> Option<Outcome> {
        if self.job.goal.holds_in(&self.base) {
            return Some(Outcome::Solved(Plan::of(self.job.task, Vec::new())));
        }
        self.statistics.evaluated += 1;
        let mut helpful = Vec::new();
        self.height = self.ff.relaxed_plan(&self.base, Some(&mut helpful));
        if self.height == Estimate::DEAD_END {
            return Some(Outcome::Unsolvable(UnsolvableReason::SpaceExhausted));
        }
        self.plateau(Followed::Helpful, helpful);
        None
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some((id, helpful)) = self.queue.pop_front() else {
            if self.followed == Followed::All {
                return Some(match self.steps.is_empty() && !self.pruned {
                    // Everything was visited, from the very first state.
                    true => Outcome::Unsolvable(UnsolvableReason::SpaceExhausted),
                    false => Outcome::LimitReached(Limit::Incomplete),
                });
            }
            self.plateau(Followed::All, Vec::new());
            return None;
        };
        let (task, meter) = (self.job.task, self.job.meter);
        let mut here = self.next.clone();
        self.registry.read(id, &mut here);
        let mut operators = helpful;
        if self.followed == Followed::All {
            task.successors.applicable(&here, &mut operators);
        }
        self.job.barred.filter(&mut operators);
        self.statistics.expanded += 1;
        for operator in operators {
            if meter.spend(price_of_state(here.len())) {
                return None;
            }
            self.next.copy_from_slice(&here);
            if !task.apply(operator, &here, &mut self.next) {
                self.pruned = true;
                continue;
            }
            self.statistics.generated += 1;
            let (child, new) = self.registry.insert(&self.next, Some((id, operator)));
            if !new {
                continue;
            }
            if self.job.goal.holds_in(&self.next) {
                self.steps.extend(self.registry.path(child));
                return Some(Outcome::Solved(Plan::of(task, std::mem::take(&mut self.steps))));
            }
            self.statistics.evaluated += 1;
            let mut helpful = Vec::new();
            let height = self.ff.relaxed_plan(&self.next, Some(&mut helpful));
            if meter.is_stopped() {
                return None;
            }
            if height < self.height {
                self.steps.extend(self.registry.path(child));
                self.base.copy_from_slice(&self.next);
                self.height = height;
                self.plateau(Followed::Helpful, helpful);
                return None;
            }
            if height != Estimate::DEAD_END {
                self.queue.push_back((child, helpful));
            }
        }
        None
    }
}

impl Stepwise for HillClimbing<'_> {
    fn job(&self) -> &Job<'_> {
        &self.job
    }

    fn memory(&self) -> usize {
        // The lists of helpful operators hold a few each.
        self.registry.memory() + self.queue.capacity() * (size_of::<(StateId, Vec<OperatorId>)>() + 64)
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        let answer = if std::mem::replace(&mut self.begun, true) { self.step() } else { self.begin() };
        // What a stopped step did not find is no answer: the meter says why.
        answer.filter(|answer| !self.job.meter.is_stopped() || matches!(answer, Outcome::Solved(_)))
    }
}

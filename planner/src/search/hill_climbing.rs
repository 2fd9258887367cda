//! Enforced hill-climbing on relaxed plans.
//!
//! Idea: search breadth-first from the current state, only through helpful operators (the first
//! steps of a relaxed plan), until some state has a lower estimate; commit to that state and
//! repeat. If the helpful operators do not lead to a lower estimate, try all operators. Fast if
//! plateaus are small and there are no dead ends; otherwise incomplete.
//!
//! Source: Hoffmann & Nebel, "The FF planning system", JAIR 2001, §5.1.

use super::searcher::Stepwise;
use super::space::Space;
use super::{Job, Outcome, Plan, Statistics};
use crate::heuristics::{Costs, Estimate, Ff};
use crate::ids::{OperatorId, StateId};
use std::collections::VecDeque;

/// Which operators the current breadth-first search follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Followed {
    Helpful,
    All,
}

/// The search state.
pub(crate) struct HillClimbing<'a> {
    /// The states that the current breadth-first search has met.
    space: Space<'a>,
    ff: Ff<'a>,
    /// The steps to the state where the current breadth-first search starts, and their cost.
    steps: Vec<OperatorId>,
    cost: u64,
    base: Vec<u64>,
    height: Estimate,
    followed: Followed,
    /// States, the costs of their paths, and the operators to try in them.
    queue: VecDeque<(StateId, u64, Vec<OperatorId>)>,
    begun: bool,
}

impl<'a> HillClimbing<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        Self {
            ff: Ff::new(&job, Costs::Unit),
            steps: Vec::new(),
            cost: 0,
            base: job.state.words().to_vec(),
            height: Estimate::DEAD_END,
            followed: Followed::Helpful,
            queue: VecDeque::new(),
            begun: false,
            space: Space::new(job),
        }
    }

    /// Starts a breadth-first search at `base`.
    fn plateau(&mut self, followed: Followed, helpful: Vec<OperatorId>) {
        self.followed = followed;
        self.space.next.copy_from_slice(&self.base);
        self.space.clear();
        self.queue.clear();
        self.queue.push_back((self.space.root(), self.cost, helpful));
    }

    fn begin(&mut self) -> Option<Outcome> {
        let start = self.space.root();
        let solved = self.space.solved(start);
        if solved.is_some() {
            return solved;
        }
        let mut helpful = Vec::new();
        self.height = self.estimate(&mut helpful);
        if self.height == Estimate::DEAD_END {
            return Some(self.space.exhausted(false));
        }
        self.queue.push_back((start, 0, helpful));
        None
    }

    /// Estimates the state in `next`.
    fn estimate(&mut self, helpful: &mut Vec<OperatorId>) -> Estimate {
        self.space.statistics.evaluated += 1;
        self.ff.relaxed_plan(&self.space.next, Some(helpful))
    }

    fn step(&mut self) -> Option<Outcome> {
        let Some((id, cost, helpful)) = self.queue.pop_front() else {
            if self.followed == Followed::All {
                // If the search began in the initial state, it has visited every reachable state.
                return Some(self.space.exhausted(!self.steps.is_empty() || self.space.is_bounded));
            }
            self.plateau(Followed::All, Vec::new());
            return None;
        };
        self.space.read(id);
        match self.followed {
            Followed::Helpful => self.space.expand_by(helpful, id, cost),
            Followed::All => self.space.expand(id, cost),
        }
        while let Some(child) = self.space.child() {
            if !child.is_new {
                continue;
            }
            if let Some(Outcome::Solved(rest)) = self.space.solved(child.id) {
                self.steps.extend(rest.operators);
                return Some(Outcome::Solved(Plan::of(self.space.job.task, std::mem::take(&mut self.steps))));
            }
            let mut helpful = Vec::new();
            let height = self.estimate(&mut helpful);
            if self.space.job.meter.is_stopped() {
                return None;
            }
            if height < self.height {
                self.steps.extend(self.space.registry.path(child.id));
                self.cost = child.cost;
                self.base.copy_from_slice(&self.space.next);
                self.height = height;
                self.plateau(Followed::Helpful, helpful);
                return None;
            }
            if height != Estimate::DEAD_END {
                self.queue.push_back((child.id, child.cost, helpful));
            }
        }
        None
    }
}

impl Stepwise for HillClimbing<'_> {
    fn job(&self) -> &Job<'_> {
        &self.space.job
    }

    fn memory(&self) -> usize {
        // Each list of helpful operators is short; 64 bytes are an estimate.
        let entry = size_of::<(StateId, u64, Vec<OperatorId>)>() + 64;
        self.space.registry.memory() + self.queue.capacity() * entry
    }

    fn statistics(&self) -> Statistics {
        self.space.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        let answer = if std::mem::replace(&mut self.begun, true) { self.step() } else { self.begin() };
        // If the meter stopped the step, an empty queue proves nothing; the meter holds the reason.
        answer.filter(|answer| !self.space.job.meter.is_stopped() || matches!(answer, Outcome::Solved(_)))
    }
}

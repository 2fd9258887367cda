//! The states of one search, and the one that is being expanded.
//!
//! Problem: searches that build all successors of a state differ in what they think of a child, and in
//! nothing else. Idea: this walks the operators, builds, stores and counts; the search looks at
//! each child in turn. Invariant: while a child is being looked at, `here` holds its parent and `next`
//! holds itself.

use super::registry::StateRegistry;
use super::{Job, Limit, Outcome, Plan, Statistics, UnsolvableReason};
use crate::ids::{OperatorId, StateId};
use crate::query::price_of_state;

/// A state that an operator led to.
#[derive(Clone, Copy)]
pub(crate) struct Child {
    pub(crate) id: StateId,
    pub(crate) is_new: bool,
    pub(crate) operator: OperatorId,
    /// Of the way to it through its parent.
    pub(crate) cost: u64,
}

pub(crate) struct Space<'a> {
    pub(crate) job: Job<'a>,
    pub(crate) registry: StateRegistry<'a>,
    pub(crate) statistics: Statistics,
    pub(crate) here: Vec<u64>,
    pub(crate) next: Vec<u64>,
    /// Whether a way was given up because it is too dear.
    pub(crate) is_bounded: bool,
    /// Whether a child was left out whose numbers do not fit.
    has_outgrown: bool,
    parent: StateId,
    cost: u64,
    /// The operators that are still to be applied to `here`, last first.
    operators: Vec<OperatorId>,
}

impl<'a> Space<'a> {
    /// With the job's state in `next`.
    pub(crate) fn new(job: Job<'a>) -> Self {
        Self {
            registry: StateRegistry::new(job.task, job.state.words()),
            statistics: Statistics::default(),
            here: job.state.words().to_vec(),
            next: job.state.words().to_vec(),
            is_bounded: false,
            has_outgrown: false,
            parent: StateId(0),
            cost: 0,
            operators: Vec::new(),
            job,
        }
    }

    /// Stores the state in `next`, from which all others come.
    pub(crate) fn root(&mut self) -> StateId {
        self.registry.insert(&self.next, None).0
    }

    /// Forgets all states.
    pub(crate) fn clear(&mut self) {
        self.registry = StateRegistry::new(self.job.task, &self.next);
    }

    /// Reads a state into `here`.
    pub(crate) fn read(&mut self, id: StateId) {
        self.registry.read(id, &mut self.here);
    }

    /// Sets out to build all children of the state in `here`, to which a way of this cost leads.
    pub(crate) fn expand(&mut self, id: StateId, cost: u64) {
        self.operators.clear();
        self.job.task.successors.applicable(&self.here, &mut self.operators);
        self.expand_listed(id, cost);
    }

    /// The same with some of the operators that are applicable.
    pub(crate) fn expand_by(&mut self, operators: Vec<OperatorId>, id: StateId, cost: u64) {
        self.operators = operators;
        self.expand_listed(id, cost);
    }

    fn expand_listed(&mut self, id: StateId, cost: u64) {
        self.job.barred.filter(&mut self.operators);
        self.operators.reverse();
        self.statistics.expanded += 1;
        (self.parent, self.cost) = (id, cost);
    }

    /// The next child; `None` where that was the last, or the meter is stopped.
    pub(crate) fn child(&mut self) -> Option<Child> {
        let task = self.job.task;
        while let Some(operator) = self.operators.pop() {
            if self.job.meter.spend(price_of_state(self.next.len())) {
                return None;
            }
            let cost = self.cost + u64::from(task.operators.cost(operator));
            if cost >= self.job.bound.get() {
                self.is_bounded = true;
                continue;
            }
            self.next.copy_from_slice(&self.here);
            if !task.apply(operator, &self.here, &mut self.next) {
                self.has_outgrown = true;
                continue;
            }
            self.statistics.generated += 1;
            let (id, is_new) = self.registry.insert(&self.next, Some((self.parent, operator)));
            return Some(Child { id, is_new, operator, cost });
        }
        None
    }

    /// The answer, if the state in `next` is the goal's.
    pub(crate) fn solved(&self, id: StateId) -> Option<Outcome> {
        self.job.goal.holds_in(&self.next).then(|| Outcome::Solved(self.plan(id)))
    }

    /// The way to a state.
    pub(crate) fn plan(&self, id: StateId) -> Plan {
        Plan::of(self.job.task, self.registry.path(id))
    }

    /// The answer where no state is left, and the search itself has left out some or none.
    pub(crate) fn exhausted(&self, has_left_out: bool) -> Outcome {
        match has_left_out || self.has_outgrown {
            true => Outcome::LimitReached(Limit::Incomplete),
            false => Outcome::Unsolvable(UnsolvableReason::SpaceExhausted),
        }
    }
}

//! Search for better paths to known states, for a metric that is not a sum of costs.
//!
//! Problem: the value of a step may depend on numbers that states do not hold, and a search that
//! keeps only the first path to each state never finds the better ones. Idea: a node is a path, and
//! it carries the numbers that only the metric reads. A state gets another node when a path to it
//! has a better metric value, as if the plan ended there. Nodes are taken in turns by metric value
//! and by relaxed plan. Invariant: a state has at most [`WAYS`] nodes, because a metric may improve
//! without end. Nothing is proven: a path with a worse value now may have a better one at the end.

use super::registry::StateRegistry;
use super::searcher::Stepwise;
use super::{Job, Limit, Outcome, Plan, Statistics};
use crate::heuristics::{Costs, Estimate, Ff};
use crate::ids::{OperatorId, StateId, id32};
use crate::number::Number;
use crate::query::price_of_state;
use crate::task::{State, Tally};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The most nodes of one state.
const WAYS: u8 = 16;
const NONE: u32 = u32::MAX;

struct Way {
    state: StateId,
    parent: u32,
    operator: OperatorId,
    tally: Tally,
    expanded: bool,
}

/// What the search knows about a state.
struct Known {
    measure: Option<Number>,
    estimate: Estimate,
    ways: u8,
}

/// The metric value or the estimate, the other of the two as a tie-breaker, and the path.
type Entry = Reverse<(u64, u64, u32)>;

/// The search state.
pub(crate) struct Measured<'a> {
    job: Job<'a>,
    ff: Ff<'a>,
    registry: StateRegistry<'a>,
    known: Vec<Known>,
    ways: Vec<Way>,
    by_measure: BinaryHeap<Entry>,
    by_estimate: BinaryHeap<Entry>,
    begun: bool,
    statistics: Statistics,
    best: Option<Number>,
    successors: Vec<OperatorId>,
    here: State,
    next: State,
}

impl<'a> Measured<'a> {
    pub(crate) fn new(job: Job<'a>) -> Self {
        Self {
            ff: Ff::new(&job, Costs::Unit),
            registry: StateRegistry::new(job.task, job.state.words()),
            known: Vec::new(),
            ways: Vec::new(),
            by_measure: BinaryHeap::new(),
            by_estimate: BinaryHeap::new(),
            begun: false,
            statistics: Statistics::default(),
            best: None,
            successors: Vec::new(),
            here: job.state.clone(),
            next: job.state.clone(),
            job,
        }
    }

    /// Adds a path to the state in `next`, unless a better one is known. Returns the plan if the
    /// path ends in the goal and is the best so far.
    fn add(&mut self, parent: u32, operator: OperatorId, tally: Tally) -> Option<Plan> {
        let from = (parent != NONE).then(|| (self.ways[parent as usize].state, operator));
        let (state, new) = self.registry.insert(self.next.words(), from);
        let measure = self.job.task.measure(&self.next, &tally);
        if new {
            self.statistics.evaluated += 1;
            let estimate = self.ff.relaxed_plan(self.next.words(), None);
            self.known.push(Known { measure, estimate, ways: 0 });
        }
        let known = &mut self.known[state.0 as usize];
        if known.estimate == Estimate::DEAD_END
            || known.ways == WAYS
            || !(new || is_better(measure, known.measure))
        {
            return None;
        }
        known.ways += 1;
        known.measure = measure;
        let (way, estimate) = (id32(self.ways.len()), u64::from(known.estimate.0));
        self.ways.push(Way { state, parent, operator, tally, expanded: false });
        let key = measure.map_or(u64::MAX, |m| sortable(m.to_f64()));
        self.by_measure.push(Reverse((key, estimate, way)));
        self.by_estimate.push(Reverse((estimate, key, way)));
        if !self.job.goal.holds_in(self.next.words()) || !is_better(measure, self.best) {
            return None;
        }
        self.best = measure;
        Some(self.plan(way))
    }

    fn plan(&self, mut way: u32) -> Plan {
        let mut operators = Vec::new();
        while self.ways[way as usize].parent != NONE {
            operators.push(self.ways[way as usize].operator);
            way = self.ways[way as usize].parent;
        }
        operators.reverse();
        Plan::of(self.job.task, operators)
    }

    /// Returns the next path to expand.
    fn pop(&mut self) -> Option<u32> {
        loop {
            let by_measure = self.statistics.expanded.is_multiple_of(2);
            let queue = if by_measure { &mut self.by_measure } else { &mut self.by_estimate };
            // Both queues hold every path that is not expanded.
            let Reverse((_, _, way)) = queue.pop()?;
            if !std::mem::replace(&mut self.ways[way as usize].expanded, true) {
                return Some(way);
            }
        }
    }

    fn step(&mut self) -> Option<Outcome> {
        let (task, meter) = (self.job.task, self.job.meter);
        let Some(way) = self.pop() else { return Some(Outcome::LimitReached(Limit::Incomplete)) };
        self.statistics.expanded += 1;
        self.registry.read(self.ways[way as usize].state, self.here.words_mut());
        self.successors.clear();
        task.successors.applicable(self.here.words(), &mut self.successors);
        self.job.barred.filter(&mut self.successors);
        let mut found = None;
        for i in 0..self.successors.len() {
            if meter.spend(price_of_state(self.next.words().len())) {
                break;
            }
            let operator = self.successors[i];
            self.next.words_mut().copy_from_slice(self.here.words());
            if !task.apply(operator, self.here.words(), self.next.words_mut()) {
                continue;
            }
            self.statistics.generated += 1;
            let mut tally = self.ways[way as usize].tally.clone();
            task.count(&self.here, operator, &mut tally);
            found = self.add(way, operator, tally).or(found);
        }
        found.map(Outcome::Solved)
    }
}

fn is_better(new: Option<Number>, old: Option<Number>) -> bool {
    new.is_some_and(|new| old.is_none_or(|old| new.is_below(old)))
}

/// Maps a double to an integer with the same order.
fn sortable(value: f64) -> u64 {
    let bits = value.to_bits();
    if value.is_sign_negative() { !bits } else { bits | 1 << 63 }
}

impl Stepwise for Measured<'_> {
    fn job(&self) -> &Job<'_> {
        &self.job
    }

    fn memory(&self) -> usize {
        let tally = self.ways.first().map_or(0, |w| w.tally.len() * size_of::<Option<Number>>());
        self.registry.memory()
            + self.known.capacity() * size_of::<Known>()
            + self.ways.capacity() * size_of::<Way>()
            + self.ways.len() * tally
            + (self.by_measure.capacity() + self.by_estimate.capacity()) * size_of::<Entry>()
    }

    fn statistics(&self) -> Statistics {
        self.statistics
    }

    fn next(&mut self) -> Option<Outcome> {
        if std::mem::replace(&mut self.begun, true) {
            return self.step();
        }
        let tally = self.job.task.tally();
        self.add(NONE, OperatorId(0), tally).map(Outcome::Solved)
    }
}

#[cfg(test)]
mod tests {
    use super::sortable;

    #[test]
    fn doubles_keep_their_order() {
        let values = [f64::NEG_INFINITY, -2.5, -1.0, 0.0, 0.1, 1.0, 3e9];
        assert!(values.map(sortable).is_sorted());
    }
}

//! What the wheel has seen of the graph: the last version, its predicates, the planner's state.

use crate::model::{Changes, Model};
use crate::monitoring::Deviation;
use dsr::{Delta, Snapshot, Time};
use low_to_high::{Fact, Fluent, LowToHigh, Perception};
use planner::State;
use std::sync::Arc;

pub(super) struct Sight {
    pub(super) snapshot: Snapshot,
    low_to_high: LowToHigh,
    pub(super) state: State,
    /// Since when the state is as it is, in the wheel's time.
    pub(super) since: Time,
}

impl Sight {
    /// The first look, or a new one after commits were missed.
    pub(super) fn new(perception: &Arc<Perception>, model: &Model, snapshot: Snapshot, now: Time) -> Self {
        let low_to_high = LowToHigh::new(perception.clone(), &snapshot);
        let numbers = low_to_high.numbers().map(|(fluent, value)| (fluent, Some(value)));
        let state = model.with_numbers(model.state(low_to_high.facts()), numbers);
        Self { snapshot, low_to_high, state, since: now }
    }

    /// Follows a commit: how the state changed.
    pub(super) fn follow(&mut self, model: &Model, snapshot: Snapshot, delta: &Delta, now: Time) -> Changes {
        let change = self.low_to_high.update(&snapshot, delta);
        self.snapshot = snapshot;
        let changes = model.update(&mut self.state, &change);
        if !changes.is_empty() {
            self.since = now;
        }
        changes
    }

    /// How its state differs from the one before.
    pub(super) fn differences(&self, before: &Self) -> Changes {
        let (before, after) = (&before.state, &self.state);
        let gone = before.facts().into_iter().filter(|&f| !after.contains(f)).map(|f| (f, false));
        let come = after.facts().into_iter().filter(|&f| !before.contains(f)).map(|f| (f, true));
        let facts: Vec<_> = gone.chain(come).collect();
        let numbers = facts.is_empty() && before != after;
        Changes { facts, numbers }
    }

    /// Everything that is perceived.
    pub(super) fn perceived(&self) -> (Vec<Fact>, Vec<(Fluent, f64)>) {
        let numbers = self.low_to_high.numbers().map(|(fluent, value)| (fluent.clone(), value));
        (self.low_to_high.facts().cloned().collect(), numbers.collect())
    }

    /// The state as another model has it.
    pub(super) fn restate(&mut self, model: &Model) {
        let numbers = self.low_to_high.numbers().map(|(fluent, value)| (fluent, Some(value)));
        self.state = model.with_numbers(model.state(self.low_to_high.facts()), numbers);
    }

    /// Whether a fact of the planner, or a condition of a goal, is perceived.
    pub(super) fn perceives(&self, fact: &Fact) -> bool {
        self.low_to_high.perceives(fact)
    }

    /// The tokens of the graph behind a fact.
    pub(super) fn tokens_of(&self, fact: &Fact) -> Vec<String> {
        self.low_to_high.explain(&self.snapshot, fact)
    }

    /// Adds the tokens of the graph to each reason.
    pub(super) fn name_tokens(&self, deviation: &mut Deviation) {
        for literal in &mut deviation.broken {
            if let Some(fact) = &literal.fact {
                literal.seen = self.low_to_high.explain(&self.snapshot, fact);
            }
        }
    }
}

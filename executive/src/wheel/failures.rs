//! Steps that failed, so that the same plan is not made again in the same state.
//!
//! A step that failed is barred as long as the perceived state is the one in which it failed: any change
//! may make it work. A step that failed as often as the mission allows is barred for good. Success
//! forgets.

use crate::Step;
use indexmap::IndexMap;
use planner::State;

pub(super) struct Failures {
    limit: u32,
    failed: IndexMap<Step, (u32, State)>,
}

impl Failures {
    pub(super) fn new(limit: u32) -> Self {
        Self { limit, failed: IndexMap::new() }
    }

    pub(super) fn add(&mut self, step: Step, state: &State) {
        let entry = self.failed.entry(step).or_insert_with(|| (0, state.clone()));
        entry.0 += 1;
        entry.1 = state.clone();
    }

    pub(super) fn forget(&mut self, step: &Step) {
        self.failed.shift_remove(step);
    }

    pub(super) fn barred(&self, state: &State) -> Vec<Step> {
        self.failed
            .iter()
            .filter(|(_, (count, then))| *count >= self.limit || then == state)
            .map(|(step, _)| step.clone())
            .collect()
    }
}

//! Steps that failed, so that the same plan is not made again at once.
//!
//! Problem: a step that failed may fail again for the same reason, or the reason may be over in a second. Idea: bar it for
//! a time that doubles with each failure, as long as the perceived state is the one in which it failed: any change may
//! make it work. A step that failed as often as the mission allows, with no progress between, is *given up*: barred
//! whatever the state, for a longer time, and the mission escalates. Invariant: no bar lasts for ever. Success forgets.

use super::backoff::{Backoff, after};
use crate::Step;
use dsr::Time;
use indexmap::IndexMap;
use planner::State;
use std::time::Duration;

const BARRED: Backoff = Backoff::new(Duration::from_secs(2), Duration::from_secs(60));
const GIVEN_UP: Backoff = Backoff::new(Duration::from_secs(60), Duration::from_secs(960));

pub(super) struct Failures {
    limit: u32,
    failed: IndexMap<Step, Failed>,
}

struct Failed {
    /// In a row, with no progress between.
    times: u32,
    /// The state at the last failure.
    state: State,
    /// When it may be tried again in that state.
    until: Time,
}

impl Failures {
    pub(super) fn new(limit: u32) -> Self {
        Self { limit, failed: IndexMap::new() }
    }

    pub(super) fn add(&mut self, step: Step, state: &State, now: Time) {
        let times = self.failed.get(&step).map_or(0, |before| before.times).saturating_add(1);
        let wait = match times.checked_sub(self.limit) {
            None => BARRED.wait(times),
            Some(more) => GIVEN_UP.wait(more.saturating_add(1)),
        };
        self.failed.insert(step, Failed { times, state: state.clone(), until: after(now, wait) });
    }

    pub(super) fn forget(&mut self, step: &Step) {
        self.failed.shift_remove(step);
    }

    /// The mission got on: no step has failed in a row any more.
    pub(super) fn progressed(&mut self) {
        self.failed.values_mut().for_each(|failed| failed.times = 0);
    }

    /// Everything may be tried again.
    pub(super) fn forget_all(&mut self) {
        self.failed.clear();
    }

    /// The steps that must not be tried now.
    pub(super) fn barred(&self, state: &State, now: Time) -> Vec<Step> {
        self.barring(state, now).map(|(step, _)| step.clone()).collect()
    }

    /// Those of them that failed as often as the mission allows.
    pub(super) fn given_up(&self, state: &State, now: Time) -> Vec<Step> {
        self.barring(state, now)
            .filter(|(_, failed)| failed.times >= self.limit)
            .map(|(step, _)| step.clone())
            .collect()
    }

    /// When the first bar ends.
    pub(super) fn next_end(&self, state: &State, now: Time) -> Option<Time> {
        self.barring(state, now).map(|(_, failed)| failed.until).min()
    }

    fn barring<'f>(&'f self, state: &'f State, now: Time) -> impl Iterator<Item = (&'f Step, &'f Failed)> {
        self.failed.iter().filter(move |(_, f)| now < f.until && (f.times >= self.limit || f.state == *state))
    }
}

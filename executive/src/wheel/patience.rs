//! Progress, and how much may happen without any.
//!
//! Problem: each replan can be right, and the mission still does not get on: a person who is lost for half a second every
//! ten seconds hears the beginning of the same explanation all day. Idea: progress is what never was before in this
//! mission: a step that is achieved for the first time, or a fact that an adopted plan is to bring about and that holds for
//! the first time. There are finitely many of both, so a world that only repeats itself makes none. What happens
//! between two moments of progress is counted; each count has a bound. A bound that is reached is *escalated*: the
//! counts start anew, and each bound is twice as large, up to four times its size. Progress restores the mission's own
//! bounds. A mission that did not get on after three escalations in a row is given up: the next one is the fallback, and
//! it stays with the human who has come.

use super::policy::Bounds;
use crate::Model;
use crate::outcome::Stuck;
use planner::{FactId, OperatorId, State, Task};
use rustc_hash::{FxHashMap, FxHashSet};

/// How often a bound doubles.
const DOUBLINGS: u32 = 2;
/// Escalations without progress after which a mission is given up.
const ESCALATIONS: u32 = 3;

pub(super) struct Patience {
    bounds: Bounds,
    /// Escalations since the last progress.
    level: u32,
    plans: u32,
    starts: FxHashMap<OperatorId, u32>,
    asks: u32,
    /// The facts that have held.
    held: FxHashSet<FactId>,
    /// The facts that an adopted plan was to bring about.
    wanted: FxHashSet<FactId>,
    achieved: FxHashSet<OperatorId>,
}

impl Patience {
    pub(super) fn new(bounds: Bounds) -> Self {
        Self {
            bounds,
            level: 0,
            plans: 0,
            starts: FxHashMap::default(),
            asks: 0,
            held: FxHashSet::default(),
            wanted: FxHashSet::default(),
            achieved: FxHashSet::default(),
        }
    }

    /// The same of another model, by names.
    pub(super) fn rename(&mut self, old: &Model, new: &Model) {
        let facts = |of: &FxHashSet<FactId>| -> FxHashSet<FactId> {
            of.iter().filter_map(|&fact| new.fact(&old.name(fact)?)).collect()
        };
        let (held, wanted) = (facts(&self.held), facts(&self.wanted));
        (self.held, self.wanted) = (held, wanted);
        let steps: Vec<_> = self.achieved.iter().map(|&step| old.step(step)).collect();
        self.achieved = new.operators(&steps).into_iter().flatten().collect();
        let (steps, times): (Vec<_>, Vec<_>) =
            self.starts.drain().map(|(step, times)| (old.step(step), times)).unzip();
        let renamed = new.operators(&steps).into_iter().zip(times);
        self.starts = renamed.filter_map(|(step, times)| Some((step?, times))).collect();
    }

    /// How many escalations there were since the last progress.
    pub(super) fn level(&self) -> u32 {
        self.level
    }

    /// Whether it was escalated so often that the mission is given up.
    pub(super) fn is_over(&self) -> bool {
        self.level > ESCALATIONS
    }

    /// What holds before anything is done is no progress.
    pub(super) fn begins_with(&mut self, state: &State) {
        self.held.extend(state.facts());
    }

    /// Facts became true. Whether that is progress.
    pub(super) fn became_true(&mut self, facts: impl Iterator<Item = FactId>) -> bool {
        let mut progress = false;
        for fact in facts {
            progress |= self.held.insert(fact) && self.wanted.contains(&fact);
        }
        if progress {
            self.progressed();
        }
        progress
    }

    /// A step was achieved. Whether that is progress.
    pub(super) fn achieved(&mut self, step: OperatorId) -> bool {
        let progress = self.achieved.insert(step);
        if progress {
            self.progressed();
        }
        progress
    }

    fn progressed(&mut self) {
        self.level = 0;
        self.start_anew();
    }

    /// A plan is to be adopted.
    pub(super) fn adopts(&mut self, task: &Task, plan: &[OperatorId]) -> Result<(), Stuck> {
        self.plans += 1;
        // The first plan since progress replaces one that made progress.
        if self.plans > self.most(self.bounds.replans).saturating_add(1) {
            return Err(Stuck::Replans(self.plans - 1));
        }
        self.asks = 0;
        self.wanted.extend(plan.iter().flat_map(|&step| task.operator(step).adds.iter().copied()));
        Ok(())
    }

    /// Whether a step may start; if not, how often it has been started again.
    pub(super) fn may_start(&self, step: OperatorId) -> Result<(), u32> {
        let most = self.most(self.bounds.restarts);
        match self.starts.get(&step) {
            Some(&times) if times > most => Err(times - 1),
            _ => Ok(()),
        }
    }

    /// A step starts, or goes on after its plan did not fit for a while.
    pub(super) fn starts(&mut self, step: OperatorId) -> Result<(), u32> {
        self.may_start(step)?;
        *self.starts.entry(step).or_default() += 1;
        Ok(())
    }

    /// Decision Support is to be asked again, because the world has overtaken its answer. How often in a row.
    pub(super) fn asks_again(&mut self) -> Result<u32, Stuck> {
        self.asks += 1;
        if self.asks > self.most(self.bounds.asks) { Err(Stuck::Asks(self.asks - 1)) } else { Ok(self.asks) }
    }

    /// A bound was reached and something was done about it.
    pub(super) fn escalated(&mut self) {
        self.level += 1;
        self.start_anew();
    }

    fn start_anew(&mut self) {
        self.plans = 0;
        self.starts.clear();
        self.asks = 0;
    }

    fn most(&self, bound: u32) -> u32 {
        bound.saturating_mul(1 << self.level.min(DOUBLINGS))
    }
}

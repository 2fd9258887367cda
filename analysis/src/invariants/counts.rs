//! How many atoms of each instance of an invariant hold initially.
//!
//! Idea: an invariant only says that one does not become two; a problem's initial state says where the
//! number starts. Invariant: an instance without initial atoms is not listed, and none of its atoms ever holds.

use pddl::model::{ObjectId, Problem, TimedChange, TimedInitial};
use rustc_hash::{FxHashMap, FxHashSet};

use super::invariant::Invariant;

/// The numbers of one invariant.
pub struct Counts {
    of: FxHashMap<Vec<ObjectId>, u32>,
    most: u32,
}

impl Counts {
    /// Of a problem; `None` if something happens by itself that may break the invariant, or if an
    /// object of several types may.
    pub fn new(invariant: &Invariant, problem: &Problem) -> Option<Self> {
        let breaks = |t: &TimedInitial| match &t.change {
            TimedChange::Add(fact) => invariant.member(fact.predicate).is_some(),
            _ => false,
        };
        if problem.timed.iter().any(breaks) || problem.objects.iter().any(|o| o.types.are_several()) {
            return None;
        }
        let mut of: FxHashMap<Vec<ObjectId>, u32> = FxHashMap::default();
        let mut seen = FxHashSet::default();
        for fact in &problem.init {
            if let Some(member) = invariant.member(fact.predicate)
                && seen.insert((fact.predicate, &fact.arguments))
            {
                *of.entry(member.instance(&fact.arguments)).or_default() += 1;
            }
        }
        let most = of.values().copied().max().unwrap_or(0);
        Some(Self { of, most })
    }

    /// Whether at most one atom of the instance ever holds.
    pub fn is_exclusive(&self, instance: &[ObjectId]) -> bool {
        self.of.get(instance).copied().unwrap_or(0) <= 1
    }

    /// Whether that is so of every instance.
    pub fn all_exclusive(&self) -> bool {
        self.most <= 1
    }
}

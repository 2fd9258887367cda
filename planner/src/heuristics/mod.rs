//! Heuristics, one file each.
//!
//! A heuristic estimates how far a state is from the goal of one query. It declares what a search
//! may rely on ([`Properties`]); a test walks the registry of configurations and holds it to that.

mod add;
mod blind;
mod counted_plan;
mod explorer;
mod ff;
mod goal_count;
mod landmarks;
mod lm_cut;
mod max;
mod repetitions;

pub(crate) use explorer::{Combine, Counting, Explorer};
pub(crate) use ff::Ff;
use landmarks::LandmarkCount;
pub(crate) use landmarks::LandmarkGraph;

use crate::ids::{OperatorId, StateId};
use crate::search::Job;
use add::Add;
use blind::Blind;
use goal_count::GoalCount;
use lm_cut::LmCut;
use max::Max;

/// What a search may rely on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Properties {
    /// Never above the true cost.
    pub admissible: bool,
    /// Falls by no more than the operator's cost along any step.
    pub consistent: bool,
    /// Infinite only where the goal cannot be reached.
    pub safe: bool,
    /// Parts of the language under which the above holds.
    pub supports: &'static [Supported],
}

/// A part of the language that estimates must know of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Supported {
    /// Literals that must not hold.
    NegativeConditions,
    /// Effects under a condition.
    ConditionalEffects,
    /// Derived facts; their negation counts as true.
    Axioms,
    /// What operators cost.
    ActionCosts,
    /// How often an operator must be repeated for a comparison of numbers; the others take once for
    /// enough.
    Repetitions,
}

/// Which costs of operators a heuristic counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Costs {
    /// Each operator counts 1: estimates the length of the plan.
    Unit,
    /// Operators count what they cost and 1 more, so that no step is free.
    PlusOne,
    /// Operators count what they cost.
    Real,
}

impl Costs {
    /// What an operator of this cost counts.
    pub(crate) fn of(self, cost: u32) -> u32 {
        match self {
            Self::Unit => 1,
            Self::PlusOne => cost.saturating_add(1),
            Self::Real => cost,
        }
    }
}

/// The estimators that configurations name; [`HeuristicKind::properties`] says what they promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HeuristicKind {
    /// 0 everywhere.
    Blind,
    /// Unsatisfied goals.
    GoalCount,
    /// Cost of the dearest proposition of the goal in the delete relaxation.
    Max,
    /// Sum of the costs of the goal's propositions in the delete relaxation.
    Add,
    /// Cost of a relaxed plan.
    Ff,
    /// Landmarks still to be achieved.
    Landmarks,
    /// Landmark cuts.
    LmCut,
}

impl HeuristicKind {
    /// Every kind.
    pub const ALL: &'static [Self] =
        &[Self::Blind, Self::GoalCount, Self::Max, Self::Add, Self::Ff, Self::Landmarks, Self::LmCut];

    /// What holds of it with real costs.
    pub fn properties(self) -> Properties {
        let (admissible, consistent) = match self {
            Self::Blind | Self::Max => (true, true),
            Self::LmCut => (true, false),
            Self::GoalCount | Self::Add | Self::Ff | Self::Landmarks => (false, false),
        };
        // Those that count facts or landmarks take every operator for the same.
        const ALL: &[Supported] = &[
            Supported::NegativeConditions,
            Supported::ConditionalEffects,
            Supported::Axioms,
            Supported::ActionCosts,
            Supported::Repetitions,
        ];
        let supports = match self {
            Self::GoalCount | Self::Landmarks => ALL.split_at(3).0,
            Self::LmCut => ALL.split_at(4).0,
            _ => ALL,
        };
        Properties { admissible, consistent, safe: true, supports }
    }

    /// An estimator for one job. Where its meter is stopped meanwhile, it is of no use.
    pub(crate) fn build<'a>(self, job: &Job<'a>, costs: Costs) -> Box<dyn Heuristic + Send + 'a> {
        match self {
            Self::Blind => Box::new(Blind),
            Self::GoalCount => Box::new(GoalCount::new(job.goal)),
            Self::Max => Box::new(Max::new(job, costs)),
            Self::Add => Box::new(Add::new(job, costs)),
            Self::Ff => Box::new(Ff::new(job, costs)),
            Self::Landmarks => Box::new(LandmarkCount::new(job, costs)),
            Self::LmCut => Box::new(LmCut::new(job, costs)),
        }
    }
}

/// An estimate; [`Estimate::DEAD_END`] says that the goal cannot be reached.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Estimate(pub(crate) u32);

impl Estimate {
    pub(crate) const DEAD_END: Self = Self(u32::MAX);
}

/// What an estimator may look at.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'v> {
    pub(crate) id: StateId,
    pub(crate) words: &'v [u64],
    /// The operators that are applicable.
    pub(crate) applicable: &'v [OperatorId],
}

/// An estimator bound to a task, a goal and the operators that may be used.
pub(crate) trait Heuristic {
    /// Estimates a state. Where `preferred` is given, appends those of the applicable operators that
    /// look promising.
    fn estimate(&mut self, view: &View<'_>, preferred: Option<&mut Vec<OperatorId>>) -> Estimate;

    /// Told of the first state, before any estimate.
    fn start(&mut self, _id: StateId, _words: &[u64]) {}

    /// Told of each step of the search to a new or known state, before its estimate.
    fn step(&mut self, _from: StateId, _operator: OperatorId, _to: StateId, _words: &[u64]) {}

    /// What the way to the goal behind the last estimate costs in real costs; 0 where there is none.
    fn rest(&self) -> u64 {
        0
    }

    /// Bytes held, where they grow with the search.
    fn memory(&self) -> usize {
        0
    }
}

//! The heuristics by name, and what each promises.

use super::add::Add;
use super::blind::Blind;
use super::ff::Ff;
use super::goal_count::GoalCount;
use super::heuristic::{Costs, Heuristic};
use super::job::Job;
use super::landmarks::LandmarkCount;
use super::lm_cut::LmCut;
use super::max::Max;

/// What a search may rely on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Properties {
    /// Never above the true cost.
    pub(crate) admissible: bool,
    /// Falls by no more than the operator's cost along any step.
    pub(crate) consistent: bool,
    /// Infinite only where the goal cannot be reached.
    pub(crate) safe: bool,
    /// Parts of the language under which the above holds.
    pub(crate) supports: &'static [Supported],
}

/// A part of the language that estimates must know of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Supported {
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

/// The estimators that configurations name; [`HeuristicKind::properties`] says what they promise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeuristicKind {
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
    #[cfg_attr(not(test), expect(dead_code, reason = "a promise to readers, which a test holds"))]
    pub(crate) const ALL: &'static [Self] =
        &[Self::Blind, Self::GoalCount, Self::Max, Self::Add, Self::Ff, Self::Landmarks, Self::LmCut];

    /// What holds of it with real costs.
    #[cfg_attr(not(test), expect(dead_code, reason = "a promise to readers, which a test holds"))]
    pub(crate) fn properties(self) -> Properties {
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

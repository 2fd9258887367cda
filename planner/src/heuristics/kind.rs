//! The heuristics by name, with the properties of each.

use super::add::Add;
use super::blind::Blind;
use super::ff::Ff;
use super::goal_count::GoalCount;
use super::heuristic::{Costs, Heuristic};
use super::job::Job;
use super::landmarks::LandmarkCount;
use super::lm_cut::LmCut;
use super::max::Max;

/// The properties that a search may rely on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Properties {
    /// Never above the true cost.
    pub(crate) admissible: bool,
    /// Decreases by at most the operator's cost along any step.
    pub(crate) consistent: bool,
    /// Infinite only if the goal is unreachable.
    pub(crate) safe: bool,
    /// The language features for which these properties hold.
    pub(crate) supports: &'static [Supported],
}

/// A language feature that a heuristic must take into account.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Supported {
    /// Literals that must not hold.
    NegativeConditions,
    /// Conditional effects.
    ConditionalEffects,
    /// Derived facts; their negation counts as true.
    Axioms,
    /// The costs of operators.
    ActionCosts,
    /// The number of repetitions of an operator that a comparison of numbers needs; other
    /// heuristics assume that one application is enough.
    Repetitions,
}

/// The heuristics that configurations name; see [`HeuristicKind::properties`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeuristicKind {
    /// 0 everywhere.
    Blind,
    /// Unsatisfied goals.
    GoalCount,
    /// The cost of the most expensive proposition of the goal in the delete relaxation.
    Max,
    /// The sum of the costs of the goal's propositions in the delete relaxation.
    Add,
    /// The cost of a relaxed plan.
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

    /// The properties with real costs.
    #[cfg_attr(not(test), expect(dead_code, reason = "a promise to readers, which a test holds"))]
    pub(crate) fn properties(self) -> Properties {
        let (admissible, consistent) = match self {
            Self::Blind | Self::Max => (true, true),
            Self::LmCut => (true, false),
            Self::GoalCount | Self::Add | Self::Ff | Self::Landmarks => (false, false),
        };
        // Heuristics that count facts or landmarks treat all operators alike.
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

    /// Creates the heuristic for one job. If the job's meter stops meanwhile, the result is
    /// unusable.
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

//! A plan of any kind, the numbers of its steps, and their start and end times.

use crate::number::Number;
use pddl::{HierarchicalPlan, Plan, SequentialPlan, StepHead, TemporalPlan, TemporalStep};

/// A plan of any kind.
#[derive(Clone, Copy, Debug)]
pub enum PlanRef<'p> {
    /// A sequence of actions.
    Sequential(&'p SequentialPlan),
    /// Actions with times.
    Temporal(&'p TemporalPlan),
    /// Actions with the decomposition that yields them.
    Hierarchical(&'p HierarchicalPlan),
}

impl PlanRef<'_> {
    /// The number of steps.
    pub(crate) fn steps(self) -> usize {
        match self {
            Self::Sequential(plan) => plan.steps.len(),
            Self::Temporal(plan) => plan.steps.len(),
            Self::Hierarchical(plan) => plan.steps.len(),
        }
    }
}

impl<'p> From<&'p Plan> for PlanRef<'p> {
    fn from(plan: &'p Plan) -> Self {
        match plan {
            Plan::Sequential(plan) => Self::Sequential(plan),
            Plan::Temporal(plan) => Self::Temporal(plan),
            Plan::Hierarchical(plan) => Self::Hierarchical(plan),
        }
    }
}

impl<'p> From<&'p SequentialPlan> for PlanRef<'p> {
    fn from(plan: &'p SequentialPlan) -> Self {
        Self::Sequential(plan)
    }
}

impl<'p> From<&'p TemporalPlan> for PlanRef<'p> {
    fn from(plan: &'p TemporalPlan) -> Self {
        Self::Temporal(plan)
    }
}

impl<'p> From<&'p HierarchicalPlan> for PlanRef<'p> {
    fn from(plan: &'p HierarchicalPlan) -> Self {
        Self::Hierarchical(plan)
    }
}

/// A step's position in the plan, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct StepIndex(pub u32);

impl StepIndex {
    /// The number in reports, from 1.
    pub fn number(self) -> u64 {
        u64::from(self.0) + 1
    }

    /// The step at a position.
    pub(crate) fn at(position: usize) -> Self {
        Self(u32::try_from(position).unwrap_or(u32::MAX))
    }
}

/// The start of a step.
pub(crate) fn start(step: &TemporalStep) -> Number {
    Number::from_decimal(step.start)
}

/// The end of a step; its start if it has no duration.
pub(crate) fn end(step: &TemporalStep) -> Number {
    let duration = match (step.head, step.duration) {
        (StepHead::DurativeAction(_), Some(duration)) => Number::from_decimal(duration),
        _ => Number::ZERO,
    };
    // The sum of two decimals of a file always exists, if necessary rounded.
    start(step).plus(duration).unwrap_or(Number::MAX).max(start(step))
}

/// The end of the last step.
pub(crate) fn makespan(plan: &TemporalPlan) -> Number {
    plan.steps.iter().map(end).max().unwrap_or(Number::ZERO)
}

//! The metric of tasks whose plan quality is not the sum of operator costs.

use crate::ids::FluentId;
use crate::number::{Expression, Number};
use pddl::model::Objective;

/// The metric of plans.
#[derive(Clone, Debug)]
pub(crate) struct Metric {
    pub(crate) objective: Objective,
    pub(crate) expression: Expression<FluentId>,
    /// The fluent that counts the steps, if the metric reads it.
    pub(crate) steps: Option<FluentId>,
}

/// The values of the fluents that only the metric reads, after some steps.
pub(crate) type Tally = Box<[Option<Number>]>;

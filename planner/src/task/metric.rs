//! The metric of tasks whose plans cost more than the sum of their operators.

use crate::ids::FluentId;
use crate::number::{Expression, Number};
use pddl::model::Objective;

/// What a plan is measured by.
#[derive(Clone, Debug)]
pub(crate) struct Metric {
    pub(crate) objective: Objective,
    pub(crate) expression: Expression<FluentId>,
    /// The fluent that counts the steps, if the metric reads it.
    pub(crate) steps: Option<FluentId>,
}

/// Fluents that only the metric reads, after some steps.
pub(crate) type Tally = Box<[Option<Number>]>;

//! A single change of a plan or a task.

use crate::number::Number;
use crate::plan::StepIndex;
use crate::value::GroundAtom;
use pddl::model::{GroundApplication, ObjectId};
use pddl::{Decimal, HierarchicalPlan, PlanStep, Span, TemporalStep};

/// A single change that makes the plan valid.
#[derive(Clone, Debug)]
pub enum Repair {
    /// Drop a step.
    Drop(StepIndex),
    /// Insert steps before the one at a position, or at the end.
    Insert {
        /// The position.
        before: StepIndex,
        /// The steps; at least one.
        steps: Vec<PlanStep>,
    },
    /// Insert a step into a plan with times.
    InsertAt {
        /// The step with its times.
        step: TemporalStep,
        /// The delay of all other steps that start then or later, in seconds.
        delay: Decimal,
    },
    /// Move a step to an earlier or later position.
    Move {
        /// The step or fluent.
        step: StepIndex,
        /// The step before which it goes; the end if the position has no step.
        before: StepIndex,
    },
    /// Swap two steps.
    Swap {
        /// The earlier one.
        first: StepIndex,
        /// The later one.
        second: StepIndex,
    },
    /// Give a step another argument.
    Replace {
        /// The step or fluent.
        step: StepIndex,
        /// All its new arguments.
        arguments: Vec<ObjectId>,
    },
    /// Start a step at another time.
    Shift {
        /// The step or fluent.
        step: StepIndex,
        /// The new start, in seconds.
        start: Decimal,
    },
    /// Delay a step and all that start with it or later.
    Delay {
        /// The first delayed step.
        step: StepIndex,
        /// The delay, in seconds.
        by: Decimal,
    },
    /// Give a step another duration.
    Stretch {
        /// The step or fluent.
        step: StepIndex,
        /// The new duration, in seconds.
        duration: Decimal,
    },
    /// Give the same steps another decomposition.
    Decompose(Box<HierarchicalPlan>),
    /// Add a fact to the initial state.
    Initially(GroundAtom),
    /// Remove a fact from the initial state.
    NotInitially(GroundAtom),
    /// Give a fluent another initial value.
    Value {
        /// The step or fluent.
        fluent: GroundApplication,
        /// Its value.
        value: Number,
    },
    /// Remove a part of the failing action's condition.
    Without {
        /// Its place in the domain.
        span: Span,
    },
}

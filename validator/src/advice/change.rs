//! A single change of a plan or a task.

use crate::number::Number;
use crate::plan::StepIndex;
use crate::value::GroundAtom;
use pddl::model::{GroundApplication, ObjectId};
use pddl::{Decimal, HierarchicalPlan, PlanStep, Span, TemporalStep};

/// One change after which the plan is valid.
#[derive(Clone, Debug)]
pub enum Repair {
    /// Leave a step out.
    Drop(StepIndex),
    /// Put steps before the one that is at a position now; behind the last one if there is none.
    Insert {
        /// Where.
        before: StepIndex,
        /// What; at least one.
        steps: Vec<PlanStep>,
    },
    /// Put a step into a plan with times.
    InsertAt {
        /// The step with its times.
        step: TemporalStep,
        /// By how much everything else that starts then or later starts later, in seconds.
        delay: Decimal,
    },
    /// Take a step earlier or later.
    Move {
        /// Which one.
        step: StepIndex,
        /// Before which one; behind the last one if there is none.
        before: StepIndex,
    },
    /// Let two steps change places.
    Swap {
        /// The earlier one.
        first: StepIndex,
        /// The later one.
        second: StepIndex,
    },
    /// Give a step another argument.
    Replace {
        /// Which one.
        step: StepIndex,
        /// All its arguments then.
        arguments: Vec<ObjectId>,
    },
    /// Start a step at another time.
    Shift {
        /// Which one.
        step: StepIndex,
        /// When, in seconds.
        start: Decimal,
    },
    /// Start a step, and all that start with it or later, later.
    Delay {
        /// From which one on.
        step: StepIndex,
        /// By how much, in seconds.
        by: Decimal,
    },
    /// Let a step take another time.
    Stretch {
        /// Which one.
        step: StepIndex,
        /// How long, in seconds.
        duration: Decimal,
    },
    /// Let the same steps come out of the task network in another way.
    Decompose(Box<HierarchicalPlan>),
    /// Let a fact hold from the beginning.
    Initially(GroundAtom),
    /// Let a fact not hold in the beginning.
    NotInitially(GroundAtom),
    /// Let a fluent have another value in the beginning.
    Value {
        /// Which one.
        fluent: GroundApplication,
        /// Its value.
        value: Number,
    },
    /// Take a part of the failing action's condition away.
    Without {
        /// Where it stands, in the domain.
        span: Span,
    },
}

impl Repair {
    /// Whether the plan is changed; otherwise it is the domain or the problem.
    pub fn is_of_plan(&self) -> bool {
        !matches!(
            self,
            Self::Initially(_) | Self::NotInitially(_) | Self::Value { .. } | Self::Without { .. }
        )
    }
}

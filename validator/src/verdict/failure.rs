//! Why a plan is not valid.

use super::fault::{ChangeFault, EffectFault, StepFault};
use super::network::NetworkFault;
use super::unsatisfied::{Operand, Unsatisfied};
use crate::cause::Cause;
use crate::number::Number;
use crate::plan::StepIndex;
use crate::value::GroundAtom;
use pddl::Span;
use pddl::model::{Comparison, EventId, GroundApplication, Name, ObjectId, PredicateId};
use serde::Serialize;

/// One of the three files that a place can lie in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum File {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
    /// The plan.
    Plan,
}

/// Why a plan is not valid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A step is not an instance of an action. (Plans that were read from text never have this fault.)
    Step {
        /// The step.
        step: StepIndex,
        /// Its fault.
        fault: StepFault,
    },
    /// A condition of a step, or of the start or end of one, does not hold.
    Precondition {
        /// The step, or its start or end.
        at: Cause,
        /// The unsatisfied parts of the condition; spans are in the domain.
        parts: Vec<Unsatisfied>,
    },
    /// A duration constraint of a step does not hold.
    Duration {
        /// The step.
        step: StepIndex,
        /// The duration of the step, in seconds.
        actual: Number,
        /// The comparison that the constraint makes.
        comparison: Comparison,
        /// The bound that it compares with.
        bound: Operand,
        /// The constraint, in the domain.
        span: Span,
    },
    /// An `over all` condition of a step does not hold.
    Invariant {
        /// The step.
        step: StepIndex,
        /// A time at which it does not hold, in seconds.
        time: Number,
        /// The unsatisfied parts; spans are in the domain.
        parts: Vec<Unsatisfied>,
    },
    /// Two simultaneous happenings interfere: their order matters.
    Interference {
        /// The first.
        first: Cause,
        /// The second.
        second: Cause,
        /// What both of them access.
        over: Shared,
    },
    /// The effects of a happening have no result.
    Effect {
        /// The happening.
        at: Cause,
        /// The reason; spans are in the domain.
        fault: EffectFault,
    },
    /// Continuous change has no result.
    Change {
        /// The time from which on it has none, in seconds.
        time: Number,
        /// The reason; spans are in the domain.
        fault: ChangeFault,
    },
    /// Events trigger each other endlessly at one time.
    EndlessEvents {
        /// The time, in seconds.
        time: Number,
        /// One of these events.
        event: EventId,
    },
    /// The trajectory violates a constraint.
    Constraint {
        /// The file with the constraint: the domain or the problem.
        file: File,
        /// The constraint, without `and` and `forall` around it.
        span: Span,
        /// The kind of violation.
        breach: Breach,
        /// The time of the violation, in seconds or steps; `None` if no state satisfies the constraint.
        time: Option<Number>,
        /// The values of the variables that are bound around it.
        binding: Vec<(Name, ObjectId)>,
        /// The number of times at which single states violate it.
        states: usize,
        /// The first of them, in seconds or steps.
        times: Vec<Number>,
        /// The unsatisfied parts in the violating state, or in the last state if a required state never came. Empty
        /// where no single condition explains the violation.
        parts: Vec<Unsatisfied>,
    },
    /// The plan is not a decomposition of the problem's task network.
    Network {
        /// The reason.
        fault: NetworkFault,
    },
    /// The goal does not hold in the last state.
    Goal {
        /// The unsatisfied parts; spans are in the problem.
        parts: Vec<Unsatisfied>,
    },
}

impl Failure {
    /// The unsatisfied parts, if the failure is about a condition.
    pub(crate) fn parts(&self) -> &[Unsatisfied] {
        match self {
            Self::Precondition { parts, .. }
            | Self::Invariant { parts, .. }
            | Self::Constraint { parts, .. }
            | Self::Goal { parts } => parts,
            _ => &[],
        }
    }
}

/// The atom or fluent that two interfering happenings both access.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shared {
    /// An atom that one adds or deletes, and the other reads or changes to the opposite.
    Atom(GroundAtom),
    /// A fluent that one changes and the other reads or changes.
    Fluent(GroundApplication),
    /// A derived predicate that one reads and that depends on an atom that the other changes.
    Derived {
        /// The derived predicate.
        predicate: PredicateId,
        /// The changed atom.
        atom: GroundAtom,
    },
}

/// The position of a state on the trajectory: 0 is the initial one.
pub(crate) type Position = usize;

/// Where and how the trajectory violates a constraint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breach {
    /// The condition does not hold in this state, and had to.
    Here(Position),
    /// The required state after this one never comes.
    NeverAfter(Position),
    /// The required state before this one is missing.
    NeverBefore(Position),
    /// The condition becomes true again in this state.
    Again(Position),
    /// No state satisfies it.
    Nowhere,
}

impl Breach {
    /// The position of the violating state.
    pub(crate) fn position(self) -> Option<Position> {
        match self {
            Self::Here(at) | Self::NeverAfter(at) | Self::NeverBefore(at) | Self::Again(at) => Some(at),
            Self::Nowhere => None,
        }
    }
}

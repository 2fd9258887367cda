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

/// One of the three texts.
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
    /// A step is not an instance of an action. (A plan that was read from text has none.)
    Step {
        /// Which one.
        step: StepIndex,
        /// What is wrong with it.
        fault: StepFault,
    },
    /// A step cannot be taken, started or ended.
    Precondition {
        /// Which one, and which end of it.
        at: Cause,
        /// What its condition lacks; spans are of the domain.
        parts: Vec<Unsatisfied>,
    },
    /// A step takes too long or too short.
    Duration {
        /// Which one.
        step: StepIndex,
        /// How long it takes, in seconds.
        actual: Number,
        /// How it must compare …
        comparison: Comparison,
        /// … with what.
        bound: Operand,
        /// Where that is asked for, in the domain.
        span: Span,
    },
    /// What must hold all the time that a step takes does not.
    Invariant {
        /// Which step.
        step: StepIndex,
        /// A time at which it does not hold, in seconds.
        time: Number,
        /// What it lacks; spans are of the domain.
        parts: Vec<Unsatisfied>,
    },
    /// Two things happen at once, and what they do or need depends on their order.
    Interference {
        /// One.
        first: Cause,
        /// The other.
        second: Cause,
        /// What they disagree about.
        over: Shared,
    },
    /// Something that can happen has no result.
    Effect {
        /// What.
        at: Cause,
        /// Why; spans are of the domain.
        fault: EffectFault,
    },
    /// Fluents that change continuously have no values.
    Change {
        /// From when on, in seconds.
        time: Number,
        /// Why; spans are of the domain.
        fault: ChangeFault,
    },
    /// Events cause each other without end, at one time.
    EndlessEvents {
        /// When, in seconds.
        time: Number,
        /// One of them.
        event: EventId,
    },
    /// The states that the plan goes through break a constraint.
    Constraint {
        /// Whether the domain or the problem has it.
        file: File,
        /// The constraint, without `and` and `forall` around it.
        span: Span,
        /// How it is broken.
        breach: Breach,
        /// When, in seconds or steps; `None` if it is nowhere satisfied.
        time: Option<Number>,
        /// The values of the variables around it.
        binding: Vec<(Name, ObjectId)>,
        /// How many times there are at which it is broken, as far as single states are at fault.
        states: usize,
        /// The first of them, in seconds or steps.
        times: Vec<Number>,
        /// What the state that is named, or the last one where something never came, lacks; empty where no single
        /// condition says it.
        parts: Vec<Unsatisfied>,
    },
    /// The plan does not come out of the problem's task network.
    Network {
        /// Why.
        fault: NetworkFault,
    },
    /// The goal does not hold in the end.
    Goal {
        /// What it lacks; spans are of the problem.
        parts: Vec<Unsatisfied>,
    },
}

impl Failure {
    /// The parts that a condition lacks, if the failure is about a condition.
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

/// What two simultaneous happenings disagree about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shared {
    /// An atom that one changes and the other needs or changes the other way.
    Atom(GroundAtom),
    /// A fluent that one changes and the other reads or changes.
    Fluent(GroundApplication),
    /// A derived predicate that one needs and that depends on what the other changes.
    Derived {
        /// What is needed.
        predicate: PredicateId,
        /// What is changed.
        atom: GroundAtom,
    },
}

/// The position of a state on the trajectory: 0 is the initial one.
pub(crate) type Position = usize;

/// Where and how a constraint is broken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Breach {
    /// In a state in which its condition had to hold.
    Here(Position),
    /// Nothing came after this state that had to come.
    NeverAfter(Position),
    /// Nothing came before this state that had to come.
    NeverBefore(Position),
    /// It became true again in this state.
    Again(Position),
    /// No state satisfies it.
    Nowhere,
}

impl Breach {
    /// The state that it is about.
    pub(crate) fn position(self) -> Option<Position> {
        match self {
            Self::Here(at) | Self::NeverAfter(at) | Self::NeverBefore(at) | Self::Again(at) => Some(at),
            Self::Nowhere => None,
        }
    }
}

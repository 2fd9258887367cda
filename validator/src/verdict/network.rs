//! Faults of a decomposition, as data.

use super::fault::StepFault;
use super::unsatisfied::Unsatisfied;
use crate::plan::StepIndex;
use pddl::model::ObjectId;
use pddl::{DecompositionId, PlanNode, PlanReference, Span};

/// The owner of a list of subtasks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parent {
    /// The problem's task network.
    Root,
    /// A task of the plan.
    Task(DecompositionId),
}

/// Why a plan is not a decomposition of the problem's task network.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NetworkFault {
    /// The problem has no task network.
    NoNetwork,
    /// The domain has no such task or method. (Plans that were read from text never have this fault.)
    Unknown {
        /// The task.
        task: DecompositionId,
    },
    /// A task's arguments do not fit its parameters. (Plans that were read from text never have this fault.)
    Arguments {
        /// The task.
        task: DecompositionId,
        /// Their fault.
        fault: StepFault,
    },
    /// A task is among its own descendants.
    Cycle {
        /// One task of the cycle.
        task: DecompositionId,
        /// The subtask that is one of its own ancestors.
        span: Span,
    },
    /// An action or task is used twice.
    Shared {
        /// The action or task.
        node: PlanNode,
        /// The first use.
        first: Span,
        /// The second use.
        second: Span,
    },
    /// An action or task is used nowhere.
    Orphan {
        /// The action or task.
        node: PlanNode,
    },
    /// The method decomposes another task.
    Method {
        /// The task.
        task: DecompositionId,
    },
    /// The method does not accept the task's arguments.
    MethodArguments {
        /// The task.
        task: DecompositionId,
        /// The first argument that does not fit.
        object: ObjectId,
        /// The position of that argument.
        position: usize,
    },
    /// No assignment of the variables makes the subtasks those of the network.
    Subtasks {
        /// The owner of the subtasks.
        of: Parent,
        /// Subtasks of the network that the plan lacks, by the nearest match.
        missing: Vec<Span>,
        /// Subtasks of the plan that the network lacks.
        surplus: Vec<PlanReference>,
    },
    /// The network's constraints do not hold for these subtasks, or a variable has no object of its type.
    Constraints {
        /// The owner of the subtasks.
        of: Parent,
        /// The unsatisfied parts.
        parts: Vec<Unsatisfied>,
    },
    /// The plan violates an ordering of the network.
    Ordering {
        /// The owner of the subtasks.
        of: Parent,
        /// The subtask that must end first.
        before: PlanReference,
        /// The subtask that begins before that.
        after: PlanReference,
    },
    /// A method's precondition holds in no state between the end of the task's predecessors and its first step.
    Precondition {
        /// The task.
        task: DecompositionId,
        /// Number of steps before the state that `parts` describes.
        after: u32,
        /// The unsatisfied parts in that state.
        parts: Vec<Unsatisfied>,
    },
    /// No decomposition of the task network yields exactly these steps in this order.
    NoDecomposition {
        /// How far a decomposition gets.
        shortfall: Shortfall,
    },
}

/// How far a decomposition of the task network gets.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shortfall {
    /// These subtasks of the problem's network have no decomposition into actions of the plan.
    Subtasks(Vec<Span>),
    /// No decomposition contains this step, at any position.
    Step(StepIndex),
    /// Some decomposition begins with this many steps. Among the decompositions that could still yield the remaining
    /// steps, the search found none that begins with more.
    Explained(u32),
}

//! What can be wrong with a decomposition, as data.

use super::fault::StepFault;
use super::unsatisfied::Unsatisfied;
use crate::plan::StepIndex;
use pddl::model::ObjectId;
use pddl::{DecompositionId, PlanNode, PlanReference, Span};

/// Whose subtasks are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Parent {
    /// The problem's task network.
    Root,
    /// A task of the plan.
    Task(DecompositionId),
}

/// Why a plan does not come out of the problem's task network.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NetworkFault {
    /// The problem has no task network.
    NoNetwork,
    /// A task or method is none of the domain's. (A plan that was read from text has none.)
    Unknown {
        /// Which task.
        task: DecompositionId,
    },
    /// A task's arguments do not fit. (A plan that was read from text has none.)
    Arguments {
        /// Which task.
        task: DecompositionId,
        /// What is wrong with them.
        fault: StepFault,
    },
    /// A task comes out of itself.
    Cycle {
        /// One of the tasks on the circle.
        task: DecompositionId,
        /// Where a subtask is a task above it.
        span: Span,
    },
    /// An action or task is used twice.
    Shared {
        /// Which one.
        node: PlanNode,
        /// Where it is used.
        first: Span,
        /// Where it is used again.
        second: Span,
    },
    /// An action or task is used nowhere.
    Orphan {
        /// Which one.
        node: PlanNode,
    },
    /// A task's method is one of another task.
    Method {
        /// Which task.
        task: DecompositionId,
    },
    /// A task's method is not for its arguments.
    MethodArguments {
        /// Which task.
        task: DecompositionId,
        /// The first argument that does not fit.
        object: ObjectId,
        /// Its position.
        position: usize,
    },
    /// The subtasks are not those of the network, whatever its variables are.
    Subtasks {
        /// Whose.
        of: Parent,
        /// What the plan lacks, at its places in the network; nothing but the nearest match can be told.
        missing: Vec<Span>,
        /// What the network lacks.
        surplus: Vec<PlanReference>,
    },
    /// The network's constraints do not hold for these subtasks, or a variable has no object of its type.
    Constraints {
        /// Whose.
        of: Parent,
        /// What they lack.
        parts: Vec<Unsatisfied>,
    },
    /// The steps of a subtask come too early.
    Ordering {
        /// Whose subtasks.
        of: Parent,
        /// What comes too late.
        before: PlanReference,
        /// What comes too early.
        after: PlanReference,
    },
    /// A method's precondition holds nowhere between what is ordered before the task and the task's first step.
    Precondition {
        /// Which task.
        task: DecompositionId,
        /// After how many steps it was looked at.
        after: u32,
        /// What it lacks there.
        parts: Vec<Unsatisfied>,
    },
    /// Nothing that the task network can become has these steps, and no others, in this order.
    NoDecomposition {
        /// How far it goes.
        shortfall: Shortfall,
    },
}

/// How far a task network can become the steps of a plan.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Shortfall {
    /// Some subtasks of the problem's network cannot be carried out with actions of the plan alone.
    Subtasks(Vec<Span>),
    /// Nothing that the network can become has this step, wherever it stands.
    Step(StepIndex),
    /// Some decomposition begins with so many steps; none that begins with more was found, among those that could
    /// still come to the rest. Others may.
    Explained(u32),
}

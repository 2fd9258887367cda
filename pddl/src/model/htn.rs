//! HDDL: compound tasks, methods and task networks.
//!
//! A network stores its partial order as pairs of positions; `:ordered-subtasks` is the chain. A primitive
//! subtask may be an action or, in a robot's `methods.hddl`, a durative action: an intention, with edits at
//! start, the expected perception at end, and the deadline as its duration.

use super::{ActionId, Condition, DurativeActionId, Name, TaskId, Term, Variables};
use crate::Span;

/// A compound task.
#[derive(Clone, Debug)]
pub struct CompoundTask {
    /// Its name.
    pub name: Name,
    /// Its typed parameters.
    pub variables: Variables,
    /// The whole definition.
    pub span: Span,
}

/// One way to carry out a task.
#[derive(Clone, Debug)]
pub struct Method {
    /// Its name.
    pub name: Name,
    /// Parameters and quantified variables.
    pub variables: Variables,
    /// The task that it decomposes.
    pub task: TaskId,
    /// The task's arguments in terms of the method's variables.
    pub task_arguments: Vec<Term>,
    /// Its precondition; the network's constraints come on top.
    pub precondition: Condition,
    /// Its subtasks and their order.
    pub network: TaskNetwork,
    /// The whole definition.
    pub span: Span,
}

/// Subtasks and their partial order.
#[derive(Clone, Debug, Default)]
pub struct TaskNetwork {
    /// The subtasks, in the order of the source.
    pub subtasks: Vec<Subtask>,
    /// `before` ends before `after` starts; acyclic.
    pub orderings: Vec<Ordering>,
    /// What must hold of the parameters in every state: `(not (= ?x ?y))`, `(sortof ?x - t)`. The
    /// conjunction at the top is flattened.
    pub constraints: Vec<Condition>,
}

/// One constraint of the partial order, by positions in [`TaskNetwork::subtasks`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Ordering {
    /// The earlier subtask.
    pub before: u32,
    /// The later subtask.
    pub after: u32,
}

/// A step of a network.
#[derive(Clone, Debug)]
pub struct Subtask {
    /// Its id in the source, if any.
    pub id: Option<Name>,
    /// The task or action that it names.
    pub head: SubtaskHead,
    /// Its arguments.
    pub arguments: Vec<Term>,
    /// Where it stands.
    pub span: Span,
}

/// The schema that a subtask names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SubtaskHead {
    /// A compound task.
    Task(TaskId),
    /// An action.
    Action(ActionId),
    /// A durative action.
    DurativeAction(DurativeActionId),
}

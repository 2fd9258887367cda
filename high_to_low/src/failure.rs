//! Why a task could not be carried out: the chain of reasons, as data. `wording` makes sentences of it.

use pddl::model::Name;
use vocabulary::{EffectError, Unmet};

use crate::ground::GroundTask;

/// Why a task could not be carried out.
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// It could not start.
    NotStarted(StartError),
    /// No method is left.
    NoMethodLeft {
        /// The task.
        task: GroundTask,
        /// Why each method failed, in the order in which they were tried; those that never applied come last.
        methods: Vec<(Name, Reason)>,
    },
}

/// Why one method failed.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Its head does not match the task's arguments.
    OtherArguments,
    /// Its precondition does not hold; the first part that fails.
    NotApplicable(Unmet),
    /// Its precondition holds, but an earlier method failed in a way that rules out every other one.
    NotTried,
    /// The precondition of an intention did not hold before its deadline.
    NotBegun {
        /// The intention.
        intention: GroundTask,
        /// The part that did not hold.
        unmet: Option<Unmet>,
    },
    /// The expectation of an intention was not seen before its deadline.
    Missed {
        /// The intention.
        intention: GroundTask,
        /// The deadline, in seconds after the intention was written.
        seconds: f64,
        /// The part that was not seen; `None` if the graph has had no version since the intention was written.
        unmet: Option<Unmet>,
    },
    /// The `over all` condition of an intention stopped holding.
    Broken {
        /// The intention.
        intention: GroundTask,
        /// The part that no longer holds.
        unmet: Unmet,
    },
    /// A subtask failed.
    Subtask(Box<Failure>),
    /// Tasks are nested deeper than any sensible method: a recursion without a base case.
    TooDeep,
    /// An argument of a subtask is unbound, or its node has left the graph.
    NoArgument {
        /// The name of the subtask.
        subtask: Name,
    },
    /// The edits of an intention cannot be made.
    NoEdits {
        /// The intention.
        intention: GroundTask,
        /// The reason.
        error: EffectError,
    },
}

impl Reason {
    /// Whether no other method may be tried either: the other methods of an endless recursion recurse as well.
    pub(crate) fn is_fatal(&self) -> bool {
        match self {
            Self::TooDeep => true,
            Self::Subtask(failure) => failure.is_fatal(),
            _ => false,
        }
    }
}

impl Failure {
    fn is_fatal(&self) -> bool {
        match self {
            Self::NotStarted(_) => false,
            Self::NoMethodLeft { methods, .. } => methods.iter().any(|(_, reason)| reason.is_fatal()),
        }
    }
}

/// Why a refinement cannot start.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StartError {
    /// No such task.
    #[error("there is no task `{0}`")]
    UnknownTask(Name),
    /// The wrong number of arguments.
    #[error("task `{task}` takes {expected} argument{}, not {found}", if *expected == 1 { "" } else { "s" })]
    Arity {
        /// The task.
        task: Name,
        /// How many it takes.
        expected: usize,
        /// How many it was given.
        found: usize,
    },
    /// No such node.
    #[error("there is no node `{0}` in the graph")]
    UnknownNode(Name),
}

impl From<StartError> for Failure {
    fn from(error: StartError) -> Self {
        Self::NotStarted(error)
    }
}

//! Why a task could not be carried out: the chain of reasons, as data.

use pddl::model::Name;
use std::fmt;

/// A task whose methods are all used up.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// The task with its arguments.
    pub task: String,
    /// Why each method did not do, in the order in which they were tried; those that never applied last.
    pub methods: Vec<(Name, Reason)>,
}

/// Why one method did not do.
#[derive(Clone, Debug, PartialEq)]
pub enum Reason {
    /// Its precondition does not hold; the first part that fails, as a sentence.
    NotApplicable(String),
    /// An intention's own precondition did not come to hold before its deadline.
    NotStarted {
        /// The intention.
        intention: String,
        /// What did not hold.
        unmet: String,
    },
    /// What should have been seen was not, until the deadline.
    Missed {
        /// The intention.
        intention: String,
        /// The deadline, in seconds after the intention was written.
        seconds: f64,
        /// What was not seen.
        unmet: String,
    },
    /// What must not happen happened.
    Broken {
        /// The intention.
        intention: String,
        /// What no longer holds.
        unmet: String,
    },
    /// A subtask failed.
    Subtask(Box<Failure>),
    /// Tasks are nested deeper than any sensible method: a recursion without a base case.
    TooDeep,
    /// Its edits cannot be made: a node that they name is not there.
    Impossible(String),
}

impl Reason {
    /// Whether no other method may be tried either: one that recurses without an end has brothers that do.
    pub(crate) fn is_fatal(&self) -> bool {
        match self {
            Self::TooDeep => true,
            Self::Subtask(failure) => failure.methods.iter().any(|(_, reason)| reason.is_fatal()),
            _ => false,
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
    #[error("task `{task}` takes {expected} arguments, not {found}")]
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
        let task = match &error {
            StartError::UnknownTask(name) | StartError::UnknownNode(name) => name.to_string(),
            StartError::Arity { task, .. } => task.to_string(),
        };
        Self { task, methods: vec![(Name::new("none"), Reason::Impossible(error.to_string()))] }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "no method works for {}", self.task)?;
        for (i, (method, reason)) in self.methods.iter().enumerate() {
            let separator = if i == 0 { ": " } else { "; " };
            write!(f, "{separator}{method}: {reason}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotApplicable(unmet) => write!(f, "does not apply, {unmet}"),
            Self::NotStarted { intention, unmet } => write!(f, "{intention} could not start, {unmet}"),
            Self::Missed { intention, seconds, unmet } => {
                write!(f, "{seconds} s after {intention}, {unmet}")
            }
            Self::Broken { intention, unmet } => write!(f, "{intention} was broken off, {unmet}"),
            Self::Subtask(failure) => write!(f, "{failure}"),
            Self::TooDeep => f.write_str("tasks are nested too deep; is there a recursion without an end?"),
            Self::Impossible(why) => f.write_str(why),
        }
    }
}

//! What a refinement did, for whoever watches.

use serde::Serialize;
use std::fmt;

/// One thing that HighToLow did or saw.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "refinement", rename_all = "kebab-case")]
pub enum RefinementEvent {
    /// A method was chosen for a task.
    MethodChosen {
        /// The task with its arguments.
        task: String,
        /// The method.
        method: String,
    },
    /// An intention was written.
    Written {
        /// The intention with its arguments.
        intention: String,
    },
    /// What an intention was for has been seen.
    Seen {
        /// The intention with its arguments.
        intention: String,
    },
    /// An intention failed.
    Failed {
        /// The intention with its arguments.
        intention: String,
        /// Why.
        why: String,
    },
    /// A method failed; the next one is tried if there is one.
    MethodFailed {
        /// The task with its arguments.
        task: String,
        /// The method.
        method: String,
    },
}

impl fmt::Display for RefinementEvent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MethodChosen { task, method } => write!(f, "{task} by {method}"),
            Self::Written { intention } => write!(f, "intends {intention}"),
            Self::Seen { intention } => write!(f, "sees {intention}"),
            Self::Failed { intention, why } => write!(f, "{intention} failed: {why}"),
            Self::MethodFailed { task, method } => write!(f, "{method} does not work for {task}"),
        }
    }
}

//! The events of a refinement, as data. `wording` makes sentences of them.

use pddl::model::Name;

use crate::failure::Reason;
use crate::ground::GroundTask;

/// An event of a refinement.
#[derive(Clone, Debug, PartialEq)]
pub enum RefinementEvent {
    /// A method was chosen for a task.
    MethodChosen {
        /// The task.
        task: GroundTask,
        /// The method.
        method: Name,
    },
    /// An intention was written.
    Written {
        /// The intention.
        intention: GroundTask,
    },
    /// The expectation of an intention was seen.
    Seen {
        /// The intention.
        intention: GroundTask,
    },
    /// An intention failed.
    Failed {
        /// The intention.
        intention: GroundTask,
        /// Why.
        why: Reason,
    },
    /// A method failed; the next one is tried if there is one.
    MethodFailed {
        /// The task.
        task: GroundTask,
        /// The method.
        method: Name,
    },
}

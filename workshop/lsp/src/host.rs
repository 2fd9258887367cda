//! What the server needs from the program around it: a disk, a planner, a validator.
//!
//! Problem: a server that knew the planner would tie editors to search, and one that knew the disk could not
//! be fuzzed or tested without one. Idea: two traits; the command line implements them. Invariant: their
//! functions run on the threads of jobs and never on the loop's, except [`Disk::read`] for a file that the
//! client reports as changed.

use ::diagnostics::SourceId;
use budget::Cancellation;
use pddl::{Severity, Source, Span};
use project::Project;
use std::sync::Arc;
use std::time::Duration;

/// The services of the program around the server.
#[derive(Clone)]
pub struct Host {
    /// Folders and files.
    pub disk: Arc<dyn Disk>,
    /// Planner and validator.
    pub tools: Arc<dyn Tools>,
}

/// Folders and files. Paths are absolute, with `/` between folders.
pub trait Disk: Send + Sync + std::panic::RefUnwindSafe {
    /// The contents of a folder, in order of names; empty if it cannot be read. Links to folders are left
    /// out, so that a walk ends.
    fn list(&self, folder: &str) -> Vec<Entry>;

    /// The text of a file without a byte order mark; text that is not UTF-8 is read as Latin-1.
    ///
    /// # Errors
    /// See [`ReadError`].
    fn read(&self, path: &str, max_bytes: u64) -> Result<String, ReadError>;
}

/// An entry of a folder.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entry {
    /// A file of that name.
    File(String),
    /// A folder of that name.
    Folder(String),
}

/// Why a file has no text.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ReadError {
    /// It is larger than the limit.
    #[error("it is larger than {0} bytes")]
    TooLarge(u64),
    /// The operating system's error.
    #[error("{0}")]
    Unreadable(String),
}

/// A problem of a project as it was when the request came.
#[derive(Clone, Debug)]
pub struct Task {
    /// The files; a snapshot, which shares with the server what was read already.
    pub project: Project,
    /// The problem's file.
    pub problem: SourceId,
}

/// One of the files of a task, or the plan for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum File {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
    /// The plan.
    Plan,
}

/// A message with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// Its severity.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub sentence: String,
    /// The place that it is about.
    pub place: (File, Span),
    /// Other places, each with a note.
    pub notes: Vec<((File, Span), String)>,
}

/// Planner and validator.
pub trait Tools: Send + Sync + std::panic::RefUnwindSafe {
    /// Looks for a plan.
    fn plan(&self, task: &Task, options: &PlanOptions) -> Planned;

    /// Validates a plan.
    fn validate(&self, task: &Task, plan: &Source) -> Judged;
}

/// The settings of one search for a plan.
#[derive(Clone, Debug)]
pub struct PlanOptions {
    /// The time that it may take.
    pub timeout: Duration,
    /// The name of the search; `None` selects the default search.
    pub search: Option<String>,
    /// Cancelled when the client withdraws the request.
    pub cancellation: Cancellation,
}

/// The result of planning.
#[derive(Clone, Debug)]
pub enum Planned {
    /// A plan that the validator has accepted.
    Solved {
        /// The plan as a file.
        text: String,
        /// The number of steps.
        steps: usize,
        /// The cost, as text.
        cost: String,
    },
    /// There is provably no plan.
    Unsolvable(Remark),
    /// A limit was reached; the text names it.
    Limit(String),
    /// The task has a feature that the planner does not support.
    Refused(Vec<Remark>),
    /// Domain or problem have errors, which the parser has reported.
    Unreadable,
}

/// The result of validating.
#[derive(Clone, Debug)]
pub enum Judged {
    /// The plan is valid.
    Valid {
        /// The number of steps.
        steps: usize,
        /// The cost, as text.
        cost: String,
    },
    /// The plan is invalid, or cannot be validated, with the reasons.
    Not(Vec<Remark>),
    /// Domain, problem or plan have errors, which the parser has reported.
    Unreadable,
}

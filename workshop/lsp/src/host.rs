//! What the server needs of the program around it: a disk, a planner, a validator.
//!
//! Problem: a server that knew the planner would draw an arrow between editors and search, and one that knew the
//! disk could not be fuzzed or tested without one. Idea: two traits; the command line implements them.
//! Invariant: their functions are called on threads of jobs, never on the loop's, with the one exception of
//! [`Disk::read`] for a file that the client says has changed.

use ::diagnostics::SourceId;
use pddl::{Severity, Source, Span};
use project::Project;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// What is handed in.
#[derive(Clone)]
pub struct Host {
    /// Folders and files.
    pub disk: Arc<dyn Disk>,
    /// Planner and validator.
    pub tools: Arc<dyn Tools>,
}

/// Folders and files. Paths are absolute, with `/` between folders.
pub trait Disk: Send + Sync + std::panic::RefUnwindSafe {
    /// What is in a folder, in order of names; nothing if it cannot be read. Links to folders are left out,
    /// so that no walk goes round.
    fn list(&self, folder: &str) -> Vec<Entry>;

    /// The text of a file without a byte order mark; what is not UTF-8 is read as Latin-1.
    ///
    /// # Errors
    /// See [`ReadError`].
    fn read(&self, path: &str, max_bytes: u64) -> Result<String, ReadError>;
}

/// Something in a folder.
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
    /// It is larger than was asked for.
    #[error("it is larger than {0} bytes")]
    TooLarge(u64),
    /// The system says no.
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

/// One of the texts of a task, or the plan for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum File {
    /// The domain.
    Domain,
    /// The problem.
    Problem,
    /// The plan.
    Plan,
}

/// A sentence with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Remark {
    /// How bad.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub sentence: String,
    /// Where.
    pub place: (File, Span),
    /// Other places, each with what it has to do with it.
    pub notes: Vec<((File, Span), String)>,
}

/// Planner and validator.
pub trait Tools: Send + Sync + std::panic::RefUnwindSafe {
    /// Looks for a plan, until the limits say stop.
    fn plan(&self, task: &Task, limits: &Limits) -> Planned;

    /// Judges a plan.
    fn validate(&self, task: &Task, plan: &Source) -> Judged;
}

/// How far planning may go.
#[derive(Clone, Debug)]
pub struct Limits {
    /// How long.
    pub timeout: Duration,
    /// Which search; the usual one if none is named.
    pub search: Option<String>,
    /// Whether somebody has said stop.
    pub cancelled: Cancel,
}

/// A switch that several threads hold, and that can only be turned on.
#[derive(Clone, Debug, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// Turns it on.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it is on.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// What came of planning.
#[derive(Clone, Debug)]
pub enum Planned {
    /// A plan, which the validator has accepted.
    Solved {
        /// The plan as a file.
        text: String,
        /// How many steps it has.
        steps: usize,
        /// What it costs, as a number in words.
        cost: String,
    },
    /// There is provably none.
    Unsolvable(Remark),
    /// A limit came first; this says which.
    Limit(String),
    /// There is something in the task that the planner cannot do.
    Refused(Vec<Remark>),
    /// Domain or problem have errors, which are known from reading them.
    Unreadable,
}

/// What came of validating.
#[derive(Clone, Debug)]
pub enum Judged {
    /// It reaches the goal.
    Valid {
        /// How many steps it has.
        steps: usize,
        /// What it costs, as a number in words.
        cost: String,
    },
    /// It does not, or cannot be judged, and why.
    Not(Vec<Remark>),
    /// Domain, problem or plan have errors, which are known from reading them.
    Unreadable,
}

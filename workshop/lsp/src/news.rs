//! What jobs send to the loop.

use diagnostics::SourceId;
use project::Linted;

use crate::host::{Judged, Planned};

/// The number of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct JobId(pub(crate) u32);

/// News from a job.
#[derive(Debug)]
pub(crate) enum JobNews {
    /// Its progress, in a few words.
    Progress(String),
    /// Files with their texts.
    Found(Vec<(String, String)>),
    /// A problem that the user should know.
    Trouble(String),
    /// The document has been read.
    Checked(SourceId),
    /// The lints' findings in a document.
    Linted(SourceId, Vec<Linted>),
    /// The planner's answer.
    Planned(Planned),
    /// The validator's answer.
    Judged(Judged),
    /// A panic, with its message.
    Panicked(String),
    /// The job has ended.
    Ended,
}

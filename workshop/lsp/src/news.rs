//! What jobs send to the loop.

use diagnostics::SourceId;
use project::Linted;

use crate::host::{Judged, Planned};

/// A job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct JobId(pub(crate) u32);

/// What a job says.
#[derive(Debug)]
pub(crate) enum JobNews {
    /// How far it is, in a few words.
    Progress(String),
    /// Files with their texts.
    Found(Vec<(String, String)>),
    /// Something that the user should know of.
    Trouble(String),
    /// The document has been read.
    Checked(SourceId),
    /// Warnings about a document.
    Linted(SourceId, Vec<Linted>),
    /// The planner's answer.
    Planned(Planned),
    /// The validator's.
    Judged(Judged),
    /// A bug of ours.
    Panicked(String),
    /// It is over.
    Ended,
}

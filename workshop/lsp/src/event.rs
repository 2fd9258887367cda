//! Everything that can happen to the server. Its state changes in answer to these and to nothing else.

use crate::message::Malformed;
use crate::news::{JobId, JobNews};
use lsp_server::{Message, RequestId};

/// What happens.
#[derive(Debug)]
pub(crate) enum Event {
    /// The client says something.
    Message(Message),
    /// The client says something that is no message.
    Malformed(Malformed),
    /// The client does not want an answer any more to what still waits in the queue.
    Withdrawn(RequestId),
    /// The client is gone without a word.
    InputEnded,
    /// The client does not read any more.
    OutputBroken,
    /// Nothing has happened for a while.
    Quiet,
    /// A thread of ours has something.
    Job(JobId, JobNews),
}

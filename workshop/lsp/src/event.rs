//! Everything that can happen to the server. Only events change its state.

use crate::message::Malformed;
use crate::news::{JobId, JobNews};
use lsp_server::{Message, RequestId};

/// An event.
#[derive(Debug)]
pub(crate) enum Event {
    /// The client has sent a message.
    Message(Message),
    /// The client has sent a malformed message.
    Malformed(Malformed),
    /// The client has cancelled a request that is still in the queue.
    Withdrawn(RequestId),
    /// The input has ended without `exit`.
    InputEnded,
    /// The output has failed.
    OutputBroken,
    /// A quiet period has begun.
    Quiet,
    /// A job has sent news.
    Job(JobId, JobNews),
}

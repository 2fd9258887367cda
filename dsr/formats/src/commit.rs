//! A commit as a record: one JSON object with everything that a log shows of it.

use dsr::{Change, Delta, Recording, ReflexId, Snapshot, Time};
use serde::Serialize;

/// A commit of a recording.
#[derive(Debug, Clone, Serialize)]
pub struct CommitRecord<'a> {
    /// The version that the commit made.
    pub version: u64,
    /// When, in seconds, to the millisecond.
    pub time: f64,
    /// The name of the agent that committed; empty if the recording's vocabulary does not declare the agent.
    pub writer: &'a str,
    /// A sentence for each change and for each reflex that fired.
    pub sentences: Vec<String>,
    /// The changes.
    pub changes: &'a [Change],
    /// The reflexes that fired.
    pub reflexes: &'a [ReflexId],
}

impl<'a> CommitRecord<'a> {
    /// The record of `delta`, with the names of `after`, the state that the commit left.
    pub fn new(recording: &'a Recording, delta: &'a Delta, after: &Snapshot) -> Self {
        let fired = delta.reflexes.iter().map(|reflex| format!("reflex {} fired", reflex.0));
        Self {
            version: delta.version.0,
            time: seconds(delta.time),
            writer: recording.vocabulary().agent_name(delta.writer).map_or("", |name| name),
            sentences: delta.sentences(after).into_iter().chain(fired).collect(),
            changes: &delta.changes,
            reflexes: &delta.reflexes,
        }
    }
}

/// A time in seconds, rounded to the millisecond.
#[expect(clippy::cast_precision_loss, reason = "rounded to a millisecond")]
pub fn seconds(time: Time) -> f64 {
    (time.0 as f64 / 1e6).round() / 1e3
}

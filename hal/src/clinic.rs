//! The clinician's side: calls, commands, reports.

use serde::{Deserialize, Serialize};

use crate::Operation;

/// How urgent a call is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Urgency {
    /// The first call.
    Normal,
    /// An earlier call was not attended.
    Urgent,
}

/// The clinician's console.
pub trait Clinic: Send + Sync {
    /// Calls a clinician; done when one has come and attended to the need. Dropping the operation withdraws the call. An
    /// urgent call also goes to whoever else can come. A robot that was started again makes a call that stood again, under
    /// the same `id`: the console need not take it for another one.
    fn call<'a>(&'a self, id: &'a str, need: &'a str, urgency: Urgency) -> Operation<'a, ()>;

    /// Waits for a command. Only the last command counts: another one replaces a command that no operation has taken.
    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()>;

    /// Delivers a report; done when the console has acknowledged it. A report may come again under the same `id`: the
    /// robot had not learned that it arrived.
    fn deliver<'a>(&'a self, id: &'a str, report: &'a serde_json::Value) -> Operation<'a, ()>;
}

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
    /// urgent call also goes to whoever else can come.
    fn call<'a>(&'a self, need: &'a str, urgency: Urgency) -> Operation<'a, ()>;

    /// Waits for a command. Only the last command counts: another one replaces a command that no operation has taken.
    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()>;

    /// Delivers a report; done when the console has acknowledged it.
    fn deliver<'a>(&'a self, report: &'a serde_json::Value) -> Operation<'a, ()>;
}

//! The clinician's side: calls, commands, reports.

use crate::Operation;

/// The clinician's console.
pub trait Clinic: Send + Sync {
    /// Calls a clinician; done when one has come and attended to the need. Dropping the operation withdraws the call.
    fn call<'a>(&'a self, need: &'a str) -> Operation<'a, ()>;

    /// Waits for a command. Only the last command counts: another one replaces a command that no operation has taken.
    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()>;

    /// Delivers a report; done when the console has acknowledged it.
    fn deliver<'a>(&'a self, report: &'a serde_json::Value) -> Operation<'a, ()>;
}

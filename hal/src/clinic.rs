//! The clinician's side: calls, commands, reports.

use crate::Operation;

/// The clinician's console.
pub trait Clinic: Send + Sync {
    /// Calls a clinician; done when one has come and seen to it. Dropped, the call is withdrawn.
    fn call<'a>(&'a self, need: &'a str) -> Operation<'a, ()>;

    /// Waits for a command. The last command counts: pressing another one before the first was taken replaces
    /// it.
    fn next_command<'a>(&'a self, name: &'a str) -> Operation<'a, ()>;

    /// Hands a report over; done when it was acknowledged.
    fn deliver<'a>(&'a self, report: &'a serde_json::Value) -> Operation<'a, ()>;
}

//! Verdicts, traces and repairs for people and programs.
//!
//! Invariant: only `lib.rs` imports this module.

mod causes;
mod explain;
mod finding;
pub mod html;
mod interference;
mod json;
mod names;
mod network;
mod repair;
mod subject;
mod words;

pub use causes::show_cause;
pub use explain::explain;
pub use finding::{Finding, Place};
pub use json::{VerdictRecord, Word};
pub use names::{show_application, show_atom, show_diff};
pub use repair::show_repair;
pub use subject::Subject;

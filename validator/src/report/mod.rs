//! Verdicts, traces and repairs for people and programs.
//!
//! Invariant: nothing outside of this module imports it but the crate's surface.

mod causes;
mod explain;
mod finding;
mod interference;
mod names;
mod network;
mod repair;
mod words;

pub use causes::{cause_place, cause_time, show_cause};
pub use explain::explain;
pub use finding::{Finding, Place};
pub use interference::{Access, Interference, interference_of};
pub use names::{
    show_application, show_atom, show_diff, show_object, show_preference, show_step, show_timed_step,
};
pub use repair::show_repair;

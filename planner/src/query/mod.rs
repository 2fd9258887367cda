//! A question on a task, and what its searches have used up.
//!
//! Heuristics and searches both work on a question, so it stands below them.

mod meter;
mod question;

pub use meter::Limit;
pub(crate) use meter::{SearchMeter, Signal, Turn, UNLIMITED, price_of_state};
pub(crate) use question::Barred;
pub use question::Query;

//! A query on a task, and the meter of its searches.
//!
//! Heuristics and searches both use a query, so it is a layer below them.

mod meter;
mod question;

pub use meter::Limit;
pub(crate) use meter::{SearchMeter, Signal, Turn, UNLIMITED, price_of_state};
pub(crate) use question::Barred;
pub use question::Query;

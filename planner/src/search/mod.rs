//! Forward search: one call, configured by name.
//!
//! [`solve`] takes a grounded task, a [`Query`] (initial state, goal, excluded operators), a
//! [`SearchConfiguration`] and a [`Budget`]. [`improve`] continues to better plans. There is no
//! global state, and nothing reads a clock. With a configuration of one thread, the same call gives
//! the same answer.

mod anytime;
mod bfws;
mod chance;
mod configuration;
mod distance;
mod dual_bfws;
mod eager;
mod edges;
mod elimination;
mod engine;
mod hill_climbing;
mod improving;
mod lazy;
mod measured;
mod novelty;
mod open_list;
mod order;
mod outcome;
mod portfolio;
mod registry;
mod reordering;
mod repair;
mod searcher;
mod solve;
mod space;
mod type_list;
mod windows;

pub use crate::query::{Limit, Query};
pub use anytime::{Improved, Quality, improve};
pub use configuration::SearchConfiguration;
pub use distance::Distance;
pub use elimination::still_needed;
pub use outcome::{Outcome, Plan, Report, Statistics, UnsolvableReason};
pub(crate) use registry::StateRegistry;
pub use repair::{Attempt, Preference, Repair, Repaired, Way, repair};
pub(crate) use searcher::Searcher;
pub use solve::solve;

pub(crate) use crate::heuristics::{Bound, Job, Shared};
pub(crate) use crate::query::{Barred, SearchMeter, Turn};

//! The wheel turned by hand: the test plays graph, planner thread, clock and the lighter.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod bench;
mod deciding;
mod goals;
mod progress;
mod shell;
mod time;
mod together;
mod trouble;
mod turning;

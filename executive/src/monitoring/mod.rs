//! Monitoring: does the plan still fit the perceived state?
//!
//! Problem: comparing the predicted state with the perceived one calls the planner for changes that do
//! not matter, and never notices that a step has become unnecessary. Idea: regress the goal through the
//! plan; suffix *i* reaches the goal from here exactly where its condition holds. The furthest condition that
//! holds decides: the goal's own → done, a later one → skip ahead, the current one → go on, none →
//! plan anew, with what the current suffix needs and does not find as the reason.
//!
//! The regression is the planner's ([`planner::Suffixes`]). It is exact for conditional effects, comparisons of
//! numbers and axioms; its docs list what it refuses, and only the suffixes that contain that are simulated.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972 (PLANEX).

mod deviation;
mod monitor;

pub use deviation::{BrokenLiteral, Deviation};
pub use monitor::Monitor;

//! Monitoring: does the plan still fit the perceived state?
//!
//! Problem: comparing the predicted state with the perceived one calls the planner for changes that do
//! not matter, and never notices that a step has become unnecessary. Idea: regress the goal through the
//! plan; suffix *i* reaches the goal from here exactly where its kernel holds. The furthest kernel that
//! holds decides: the goal's own → done, a later one → skip ahead, the current one → go on, none →
//! plan anew, with the literals of the current kernel that fail as the reason.
//!
//! Source: Fikes, Hart & Nilsson, "Learning and executing generalized robot plans", AIJ 1972 (PLANEX).

mod deviation;
mod kernels;
mod monitor;

pub use deviation::{BrokenLiteral, Deviation};
pub use monitor::Monitor;

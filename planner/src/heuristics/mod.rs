//! Heuristics, one file each.
//!
//! A heuristic estimates the distance from a state to the goal of one query. It declares its
//! properties (`kind::Properties`); a test checks them for every configuration in the registry.

mod add;
mod blind;
mod counted_plan;
mod explorer;
mod ff;
mod goal_count;
mod heuristic;
mod job;
mod kind;
mod landmarks;
mod lm_cut;
mod max;
mod repetitions;

pub(crate) use explorer::{Combine, Counting, Explorer};
pub(crate) use ff::Ff;
pub(crate) use heuristic::{Costs, Estimate, Heuristic, View};
pub(crate) use job::{Bound, Job, Shared};
pub(crate) use kind::HeuristicKind;

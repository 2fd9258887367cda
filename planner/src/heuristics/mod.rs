//! Heuristics, one file each.
//!
//! A heuristic estimates how far a state is from the goal of one query. It declares what a search
//! may rely on (`kind::Properties`); a test walks the registry of configurations and holds it to that.

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

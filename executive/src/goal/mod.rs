//! The goals of a mission as text and as literals of the planner. What becomes of them over time is in `goals`.

mod compile;
mod set;
mod text;

pub(crate) use set::Goals;
pub use text::{GoalId, GoalText, Importance};

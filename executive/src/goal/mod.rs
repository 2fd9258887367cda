//! The goals of a mission as text and as literals of the planner. What becomes of them over time is in `goals`.

mod compile;
mod set;
mod soft;
mod text;

pub(crate) use set::Goals;
pub(crate) use soft::{Compilation, compile as compile_soft};
pub use text::{GoalId, GoalText, Importance};

//! Goals with a life: which are wanted now, which the next plan serves, and why the others wait.
//!
//! Problem: a mission owes more than one thing, and not all of them at every moment: a visitor is to be greeted when one
//! comes, the battery to be charged when it is low, the test to be finished after that. Idea: a goal has a life of a few
//! stages, and every change of it follows from what is sensed: its condition, and the conditions under which it is wanted,
//! held and dropped, are facts like all others. A plan is made for as many goals as one plan can reach, the most important
//! ones first. No plan is kept for a goal that waits: what was achieved stays achieved, and the rest is planned from what
//! is sensed then.
//!
//! From the ground up: `life` (the stages) → `agenda` (all goals of a mission over time) and `choice` (which of them one
//! plan serves). All of it is pure; the wheel asks the agenda, Decision Support makes the choice. What a goal is as text,
//! and as literals of the planner, is in `goal`.
//!
//! Source: Niemueller, Hofmann & Lakemeyer, "Goal reasoning in the CLIPS Executive for integrated planning and
//! execution", ICAPS 2019, for the life of a goal (formulated, selected, …, retracted) and for goals that are maintained.
//! Where we deviate: goals of one level are planned for together, and not one after the other; there are no
//! trees of goals, because a conjunction is planned for and alternatives are a disjunction in the goal's condition.

mod agenda;
mod choice;
mod life;

pub(crate) use agenda::{Agenda, Review, View};
pub use choice::Stage;
pub(crate) use choice::{Aim, Choice, choose};
pub use life::{GoalChange, Life, Reason};

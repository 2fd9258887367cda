//! The High Level Executive: one turn of the wheel per event.
//!
//! Problem: an executive that waits for its planner cannot notice that the patient left; one that acts on
//! what it believes talks to an empty chair. Idea: a pure state machine, `step(event) -> effects`. Time is
//! an argument; committing, planning and timers are effects that the shell carries out. Planning does
//! not stop the wheel: a decision is compared with the present before it is used.
//!
//! A turn: LowToHigh reports which predicates changed → Monitoring finds the furthest suffix of the plan that
//! still reaches the goal → the goal holds: done · a later suffix: skip ahead · the current one: refine on ·
//! none: ask Decision Support, with the reason. No plan: the mission's fallback, until there is one. No progress: the
//! mission's escalation. The wheel ends with the goal, with a human, or at the horizon of the run; never because
//! something failed.
//!
//! **Invariant:** the same events at the same times give the same effects. **Invariant:** a step counts as done only when
//! LowToHigh sees what it was to achieve. **Invariant:** without an end, a wheel has asked for a plan, waits for a time, or
//! carries something out.
//!
//! From the ground up: `policy` (what the mission decides), `backoff`, `clock` (time without stops), `failures`,
//! `patience` (progress), `sight` (what is seen) → `event`, `effects` → `course` (a plan under way), `errand` (a task
//! outside a plan) → `state` (the wheel) → `turn`, and what a turn may lead to: `acting`, `deciding`, `goals`, `objects`, `trouble`.
//!
//! Source: §4.2 of the CORTEX/CLARC paper (HLE, Monitoring, Decision Support, HighToLow, LowToHigh).

mod acting;
mod backoff;
mod clock;
mod course;
mod deciding;
mod effects;
mod errand;
mod event;
mod failures;
mod goals;
mod objects;
mod patience;
mod policy;
mod sight;
mod state;
mod trouble;
mod turn;

pub use event::{Effect, Event};
pub use policy::{Bounds, Policy};
pub use state::Wheel;

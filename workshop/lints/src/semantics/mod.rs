//! W0850 on: what never happens, what never holds, and why.
//!
//! A finding names the root cause, and lists with it what never happens because of it.

mod contradictory_condition;
mod contradictory_goal;
mod dead;
mod dead_action;
mod dead_axiom;
mod dead_conditional_effect;
mod dead_method;
mod division_by_zero;
pub(crate) mod exclusion;
mod idle_schema;
mod impossible_task;
mod negative_duration;
mod unreachable_goal;

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[
    &dead_action::LINT,
    &dead_axiom::LINT,
    &dead_conditional_effect::LINT,
    &dead_method::LINT,
    &impossible_task::LINT,
    &unreachable_goal::LINT,
    &idle_schema::LINT,
    &contradictory_condition::LINT,
    &contradictory_goal::LINT,
    &negative_duration::LINT,
    &division_by_zero::LINT,
];

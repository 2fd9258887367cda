//! W08: conditions, effects, initial states, goals.

mod aliased_effect;
mod always_false;
mod always_true;
mod broken_over_all;
mod changes;
mod conflicting_value;
mod constant_metric;
mod contradictory_effect;
mod dead_when;
mod duplicate_action;
mod early_result;
mod effect_without_change;
mod goal_already_true;
mod literals;
mod needless_when;
mod repeated_condition;
mod repeated_effect;
mod repeated_fact;
mod static_goal;
mod static_when;
mod timed_without_change;
mod uninitialised_function;

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[
    &always_false::LINT,
    &always_true::LINT,
    &repeated_condition::LINT,
    &contradictory_effect::LINT,
    &repeated_effect::LINT,
    &effect_without_change::LINT,
    &needless_when::LINT,
    &dead_when::LINT,
    &duplicate_action::LINT,
    &broken_over_all::LINT,
    &early_result::LINT,
    &static_goal::LINT,
    &goal_already_true::LINT,
    &repeated_fact::LINT,
    &conflicting_value::LINT,
    &uninitialised_function::LINT,
    &constant_metric::LINT,
    &aliased_effect::LINT,
    &static_when::LINT,
    &timed_without_change::LINT,
];

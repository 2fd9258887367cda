//! W09: tasks and methods.

mod duplicate_method;
mod endless_recursion;
mod task_without_method;
mod unused_action;
mod unused_task;
mod wide_subtask;

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[
    &task_without_method::LINT,
    &unused_task::LINT,
    &endless_recursion::LINT,
    &unused_action::LINT,
    &wide_subtask::LINT,
    &duplicate_method::LINT,
];

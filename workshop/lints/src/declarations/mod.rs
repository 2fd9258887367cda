//! W07: declarations, requirements, names.

mod duplicate_type;
mod features;
mod never_needed_predicate;
mod never_read_function;
mod never_true_predicate;
mod shadowed_variable;
mod synonym_requirement;
mod unconstrained_parameter;
mod undeclared_requirement;
mod unknown_lint;
mod untyped_parameter;
mod unused_constant;
mod unused_function;
mod unused_object;
mod unused_parameter;
mod unused_predicate;
mod unused_requirement;
mod unused_type;
mod unused_variable;
mod wide_argument;

pub(crate) use wide_argument::type_text;

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[
    &unknown_lint::LINT,
    &undeclared_requirement::LINT,
    &unused_requirement::LINT,
    &unused_predicate::LINT,
    &never_needed_predicate::LINT,
    &never_true_predicate::LINT,
    &unused_function::LINT,
    &unused_type::LINT,
    &unused_constant::LINT,
    &unused_parameter::LINT,
    &unused_variable::LINT,
    &unconstrained_parameter::LINT,
    &untyped_parameter::LINT,
    &duplicate_type::LINT,
    &shadowed_variable::LINT,
    &unused_object::LINT,
    &wide_argument::LINT,
    &synonym_requirement::LINT,
    &never_read_function::LINT,
];

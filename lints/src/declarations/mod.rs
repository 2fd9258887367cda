//! W07: declarations, requirements, names.

mod unknown_lint;
mod unused_parameter;

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[&unknown_lint::LINT, &unused_parameter::LINT];

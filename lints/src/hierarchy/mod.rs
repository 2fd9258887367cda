//! W09: tasks and methods.

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[];

//! W08: conditions, effects, initial states, goals.

use crate::Lint;

pub(crate) static LINTS: &[&Lint] = &[];

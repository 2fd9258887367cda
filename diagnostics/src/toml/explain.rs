//! The explanations of the codes of this module, a page each beside it.

use std::sync::LazyLock;

use crate::{Explanation, explained};

static EXPLANATIONS: LazyLock<Vec<Explanation>> =
    LazyLock::new(|| explained![".": "E0701" "E0702" "E0703" "E0704" "E0705";]);

/// All explanations, in order of their codes.
pub fn explanations() -> impl Iterator<Item = &'static Explanation> {
    EXPLANATIONS.iter()
}

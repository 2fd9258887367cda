//! The explanations of the codes of suites, a page each in the folder `explain`.

use std::sync::LazyLock;

use diagnostics::{Explanation, explained};

#[rustfmt::skip]
static EXPLANATIONS: LazyLock<Vec<Explanation>> = LazyLock::new(|| explained![
    "explain":
        "T0101" "T0102" "T0103" "T0104" "T0106" "T0107" "T0201" "T0301" "T0302" "T0303" "T0304" "T0305" "T0306"
        "T0311";
]);

/// All explanations, in order of their codes.
pub fn explanations() -> impl Iterator<Item = &'static Explanation> {
    EXPLANATIONS.iter()
}

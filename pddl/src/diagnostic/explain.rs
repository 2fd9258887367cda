//! The explanation of every code, a page each in the folder `explain`.
//!
//! Invariant, tested: every code of a [`DiagnosticKind`](super::DiagnosticKind) has an explanation. Its wrong example
//! gives that code and no other; its right example gives none and is laid out as the formatter lays it out.

use std::sync::LazyLock;

use diagnostics::{Explanation, explained};

/// In order of the numbers.
#[rustfmt::skip]
static EXPLANATIONS: LazyLock<Vec<Explanation>> = LazyLock::new(|| explained!["explain":
    // Parentheses, sections and keys.
    "E0101" "E0102" "E0103" "E0104" "E0105" "E0106" "E0107" "E0108" "E0109" "W0110" "W0111" "W0112"
    // Names that nothing declares.
    "E0201" "E0202" "E0203" "E0204" "E0205" "E0206" "E0207" "E0208" "E0209" "E0210" "E0211" "E0212" "W0213" "E0214"
    "W0215"
    // Names with several declarations.
    "E0220" "E0221" "W0222" "W0223" "W0224"
    // Arguments, types and values.
    "E0301" "E0302" "E0303" "E0304" "E0305" "E0306" "E0307"
    // Task networks.
    "E0401"
    // Times, outcomes, and what needs a requirement.
    "E0501" "E0502" "E0503" "E0504" "E0505"
    // Preferences, constraints, metrics, continuous changes.
    "E0506" "E0507" "E0508" "E0509" "E0510"
    // Parts of the language that no model holds.
    "U0601";
]);

/// All explanations, in order of their numbers.
pub fn explanations() -> impl Iterator<Item = &'static Explanation> {
    EXPLANATIONS.iter()
}

/// The explanation of a code, in upper or lower case.
pub fn explain(code: &str) -> Option<&'static Explanation> {
    explanations().find(|e| e.code.eq_ignore_ascii_case(code))
}

//! All lints, in order of their codes.

use crate::{Lint, declarations, hierarchy, logic, semantics};

/// All lints, in order of their codes.
pub fn all() -> impl Iterator<Item = &'static Lint> {
    [declarations::LINTS, logic::LINTS, semantics::LINTS, hierarchy::LINTS].into_iter().flatten().copied()
}

/// The lint of that name or code (in any case).
pub fn find(word: &str) -> Option<&'static Lint> {
    all().find(|lint| lint.name == word || lint.code().eq_ignore_ascii_case(word))
}

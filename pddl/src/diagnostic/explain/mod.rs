//! What each code means, for whoever has met it: a file of texts for each family of codes.
//!
//! Invariant, tested: every code of a [`DiagnosticKind`](super::DiagnosticKind) has an explanation; its wrong example
//! gives that code and no other, its right one gives none and is laid out as the formatter does it.

mod declarations;
mod names;
mod networks;
mod soft;
mod syntax;
mod times;
mod types;
mod unsupported;

use diagnostics::nearest;
use serde::Serialize;

/// What a code means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Explanation {
    /// Such as `E0202`.
    pub code: &'static str,
    /// What is wrong, in a few words.
    pub title: &'static str,
    /// When it is reported.
    pub meaning: &'static str,
    /// Why it is wrong, and what to do.
    pub why: &'static str,
    /// The texts of files that give it, the domain before its problem; `…` stands for a thousand times the same.
    pub wrong: &'static [&'static str],
    /// The same without the mistake.
    pub right: &'static [&'static str],
}

/// No diagnostic has that code.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no diagnostic has the code `{code}`")]
pub struct UnknownCode {
    /// As asked for.
    pub code: String,
    /// A code that is spelled alike.
    pub suggestion: Option<&'static str>,
}

/// All explanations, in order of their numbers.
pub fn explanations() -> impl Iterator<Item = &'static Explanation> {
    [
        syntax::EXPLANATIONS,
        names::EXPLANATIONS,
        declarations::EXPLANATIONS,
        types::EXPLANATIONS,
        networks::EXPLANATIONS,
        times::EXPLANATIONS,
        soft::EXPLANATIONS,
        unsupported::EXPLANATIONS,
    ]
    .into_iter()
    .flatten()
}

/// The explanation of a code, in upper or lower case.
///
/// # Errors
/// [`UnknownCode`], with the nearest one that there is.
pub fn explain(code: &str) -> Result<&'static Explanation, UnknownCode> {
    if let Some(explanation) = explanations().find(|e| e.code.eq_ignore_ascii_case(code)) {
        return Ok(explanation);
    }
    let same_number = |e: &&Explanation| code.len() > 1 && e.code.get(1..) == code.get(1..);
    let suggestion = explanations().find(same_number).map(|e| e.code).or_else(|| {
        let near = nearest(code, explanations().map(|e| e.code))?;
        explanations().map(|e| e.code).find(|code| **code == *near)
    });
    Err(UnknownCode { code: code.to_owned(), suggestion })
}

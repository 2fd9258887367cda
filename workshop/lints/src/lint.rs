//! What a lint is.

use std::sync::LazyLock;

use diagnostics::{Explanation, Finding, Place};

use crate::finding::{Findings, Linted};
use crate::view::{DomainView, ProblemView};

/// When a lint runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Always: it almost always finds a mistake.
    Default,
    /// On request: what it finds is often intended.
    Pedantic,
}

/// One kind of modelling mistake.
#[derive(Debug)]
pub struct Lint {
    /// The name that a comment silences it by: `unused-parameter`.
    pub name: &'static str,
    /// When it runs.
    pub level: Level,
    /// Its code, its meaning, a wrong example and a right one.
    pub explanation: LazyLock<Explanation>,
    pub(crate) checks: &'static [Check],
}

impl Lint {
    /// Its stable code, `W0701`.
    pub fn code(&self) -> &'static str {
        self.explanation.code
    }

    /// A finding without labels, help and fix. `message` is one sentence without a full stop.
    pub(crate) fn finding(&self, place: Place, message: impl Into<String>) -> Linted {
        Linted { finding: Finding::warning(self.code(), place, message), lint: self.name, fix: None }
    }
}

/// The explanation of a code, from the page beside the lint's file.
macro_rules! explanation {
    ($code:literal) => {
        std::sync::LazyLock::new(|| {
            diagnostics::Explanation::included($code, include_str!(concat!($code, ".md")))
        })
    };
}
pub(crate) use explanation;

/// The function that finds the mistake.
#[derive(Debug)]
pub(crate) enum Check {
    /// In a domain alone.
    Domain(fn(&DomainView<'_>, &mut Findings)),
    /// In a problem with its domain. A finding in the *domain* is reported only if every problem gives it, at the same
    /// place in the same words.
    Problem(fn(&ProblemView<'_, '_>, &mut Findings)),
}

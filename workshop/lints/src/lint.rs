//! What a lint is.

use std::sync::LazyLock;

use pddl::Explanation;

use crate::finding::Findings;
use crate::view::{DomainView, ProblemView};

/// Who wants to read it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Level {
    /// Everybody: almost always a mistake.
    Default,
    /// Who asks for it: often meant as it is.
    Pedantic,
}

/// One kind of modelling mistake.
#[derive(Debug)]
pub struct Lint {
    /// What a comment calls it: `unused-parameter`.
    pub name: &'static str,
    /// Who wants to read it.
    pub level: Level,
    /// Its code and what it means, with a wrong example and a right one.
    pub explanation: LazyLock<Explanation>,
    pub(crate) checks: &'static [Check],
}

impl Lint {
    /// Stable code, `W0701`.
    pub fn code(&self) -> &'static str {
        self.explanation.code
    }
}

/// The explanation of a code, from the page beside the lint's file.
macro_rules! explanation {
    ($code:literal) => {
        std::sync::LazyLock::new(|| pddl::Explanation::included($code, include_str!(concat!($code, ".md"))))
    };
}
pub(crate) use explanation;

/// Looks for the mistake.
#[derive(Debug)]
pub(crate) enum Check {
    /// In a domain alone.
    Domain(fn(&DomainView<'_>, &mut Findings)),
    /// In a problem with its domain. What it finds in the *domain* is said only if every problem of the domain
    /// that is looked at gives it, at the same place in the same words.
    Problem(fn(&ProblemView<'_, '_>, &mut Findings)),
}

//! The model of `expected.toml`: each expectation with the place where it is written.
//!
//! An expectation that is not written is `None` and is not checked; `suite` fills in what a folder's name states.

use crate::Fault;
use diagnostics::SourceId;
use pddl::Span;
use std::time::Duration;
use validator::Number;

/// A value and where it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Written<T> {
    pub(crate) value: T,
    pub(crate) span: Span,
}

/// Whether warnings are allowed in files without an entry of their own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Warnings {
    #[default]
    Allow,
    Deny,
}

/// A whole file.
#[derive(Clone, Debug, Default)]
pub(crate) struct Expected {
    pub(crate) warnings: Warnings,
    /// The most time for one question to the planner.
    pub(crate) timeout: Option<Duration>,
    pub(crate) problems: Vec<ProblemEntry>,
    pub(crate) plans: Vec<PlanEntry>,
    pub(crate) diagnostics: Vec<DiagnosticsEntry>,
}

/// `[problem.NAME]`
#[derive(Clone, Debug)]
pub(crate) struct ProblemEntry {
    pub(crate) file: SourceId,
    /// The entry's key.
    pub(crate) span: Span,
    /// The question to the planner, if any.
    pub(crate) solvable: Option<Written<Solvable>>,
    pub(crate) timeout: Option<Duration>,
}

/// Whether there is a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Solvable {
    Yes(Bounds),
    No,
}

/// Bounds on the best plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bounds {
    /// No plan is cheaper, and one costs this.
    pub(crate) optimal_cost: Option<Written<Number>>,
    /// Some plan costs no more.
    pub(crate) cost_at_most: Option<Written<Number>>,
    /// Some plan has no more steps.
    pub(crate) steps_at_most: Option<Written<u32>>,
}

/// `[plan.NAME]`
#[derive(Clone, Debug)]
pub(crate) struct PlanEntry {
    pub(crate) file: SourceId,
    /// The entry's key.
    pub(crate) span: Span,
    pub(crate) problem: Option<SourceId>,
    pub(crate) verdict: Option<Written<Verdict>>,
    pub(crate) details: Details,
}

/// The verdict that is expected of a plan.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Verdict {
    Valid,
    Invalid,
    /// The plan or its task uses a feature that the validator does not support.
    Unsupported,
}

impl Verdict {
    pub(crate) const ALL: [Self; 3] = [Self::Valid, Self::Invalid, Self::Unsupported];

    pub(crate) const fn word(self) -> &'static str {
        match self {
            Self::Valid => "valid",
            Self::Invalid => "invalid",
            Self::Unsupported => "unsupported",
        }
    }

    pub(crate) fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|verdict| verdict.word() == word)
    }
}

/// What is expected beside the verdict.
#[derive(Clone, Debug, Default)]
pub(crate) struct Details {
    /// Of a valid plan: the metric's value, or how many steps it has.
    pub(crate) cost: Option<Written<Number>>,
    /// Of an invalid plan, as all that follows.
    pub(crate) why: Option<Written<Why>>,
    /// From 1.
    pub(crate) step: Option<Written<u32>>,
    /// The line of the plan that a diagnostic is about, from 1.
    pub(crate) line: Option<Written<u32>>,
    /// In the spelling of [`literal`].
    pub(crate) missing: Vec<Written<String>>,
    /// Parts of the sentences that explain it.
    pub(crate) says: Vec<Written<String>>,
}

/// Why a plan is invalid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Why {
    Fault(Fault),
    /// The code of the diagnostics about the plan's text.
    Code(String),
}

/// `[diagnostics] NAME = [..]`: these, and no others.
#[derive(Clone, Debug)]
pub(crate) struct DiagnosticsEntry {
    pub(crate) file: SourceId,
    /// The entry's key.
    pub(crate) span: Span,
    pub(crate) expected: Vec<Written<CodeAt>>,
}

/// `E0202 at 12`
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct CodeAt {
    pub(crate) code: String,
    pub(crate) line: Option<u32>,
}

/// PDDL in the one spelling that is compared: lower case, single spaces, none inside parentheses.
pub(crate) fn literal(text: &str) -> String {
    let spaced = text.to_lowercase().replace('(', " ( ").replace(')', " ) ");
    let mut written = String::new();
    for word in spaced.split_whitespace() {
        if !(written.is_empty() || written.ends_with('(') || word == ")") {
            written.push(' ');
        }
        written.push_str(word);
    }
    written
}

#[cfg(test)]
mod tests {
    use super::literal;

    #[test]
    fn spelling_does_not_count() {
        assert_eq!(literal(" ( NOT\n(at  ?x a ) )"), "(not (at ?x a))");
        assert_eq!(literal("(>=(level)0.5)"), "(>= (level) 0.5)");
    }
}

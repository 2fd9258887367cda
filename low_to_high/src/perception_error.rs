//! Why a part of `perception.pddl` cannot be evaluated.

use pddl::model::Name;
use vocabulary::{LinkErrorKind, Located, MAX_ALTERNATIVES};

/// The most literals of one alternative: matching keeps them as bits.
pub(crate) const MAX_LITERALS: usize = 64;

/// Why an axiom cannot be evaluated.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names that the variant is about")]
pub enum PerceptionErrorKind {
    /// Agents write tokens; an axiom cannot derive one.
    #[error("`{name}` is a token: agents write it, so that no axiom may derive it")]
    DerivesToken { name: Name },
    /// No agent writes it and no axiom derives it.
    #[error("`{name}` is neither a token of vocabulary `{vocabulary}` nor derived here: it never holds")]
    NeverHolds { name: Name, vocabulary: Name },
    /// It depends on its own absence.
    #[error("`{head}` depends on the absence of `{denied}`, which depends on `{head}`")]
    NotStratified { head: Name, denied: Name },
    /// Too many disjunctions.
    #[error("`{name}` has more than {MAX_ALTERNATIVES} alternatives")]
    TooManyAlternatives { name: Name },
    /// Too long.
    #[error("an alternative of `{name}` has more than {MAX_LITERALS} literals")]
    TooLong { name: Name },
    /// The graph has no such number.
    #[error(
        "a sensed number is an attribute that is a number, `(f ?x)`, or a count, `(count (?y - t) CONDITION)`"
    )]
    NotMeasured,
    /// The attribute is the same whatever the parameter is.
    #[error("the attribute does not depend on `?{variable}`")]
    NotNamed { variable: Name },
    /// Two values for one fluent.
    #[error("`{name}` is derived twice")]
    MeasuredTwice { name: Name },
    /// A part of it cannot be compiled.
    #[error(transparent)]
    Link(#[from] LinkErrorKind),
}

/// An axiom that cannot be evaluated.
pub type PerceptionError = Located<PerceptionErrorKind>;

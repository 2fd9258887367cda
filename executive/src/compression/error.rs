//! Why a durative action is refused.

use pddl::Span;
use pddl::model::Name;

/// Why a durative action cannot be planned as one step.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are the names and the place that the variant is about")]
pub enum CompressionError {
    /// Only another action could make a condition true while this one runs.
    #[error(
        "`{action}` needs another action to run at the same time: its own start takes away what it needs later; \
         a mission's plan lets actions run together, but none may depend on that"
    )]
    NeedsConcurrency { action: Name, span: Span },
    /// Only another action gives what this one needs, and only while it runs.
    #[error(
        "`{action}` needs `{predicate}`, which only `{giver}` gives, and only while it runs: a mission's plan lets \
         actions run together, but none may depend on that"
    )]
    OnlyMeanwhile { action: Name, predicate: Name, giver: Name, span: Span },
    /// A condition reads what the start changes in a way that is not followed.
    #[error(
        "`{action}` cannot be planned as one step: `{symbol}` is read later than it is changed at the start"
    )]
    TooComplex { action: Name, symbol: Name, span: Span },
}

impl CompressionError {
    /// The place in the domain.
    pub fn span(&self) -> Span {
        match self {
            Self::NeedsConcurrency { span, .. }
            | Self::OnlyMeanwhile { span, .. }
            | Self::TooComplex { span, .. } => *span,
        }
    }
}

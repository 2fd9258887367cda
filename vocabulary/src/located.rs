//! What is wrong and where: every mistake in a text of PDDL has a span of that text.

use std::error::Error;
use std::fmt;

use pddl::Span;

/// A mistake with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Located<E> {
    /// Where, in the source of the domain or problem that was read.
    pub span: Span,
    /// What.
    pub kind: E,
}

impl<E> Located<E> {
    /// The mistake at a place.
    pub fn new(span: Span, kind: E) -> Self {
        Self { span, kind }
    }
}

impl<E: fmt::Display> fmt::Display for Located<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}

impl<E: Error> Error for Located<E> {
    fn source(&self) -> Option<&(dyn Error + 'static)> {
        self.kind.source()
    }
}

//! Errors with a place: every mistake in a PDDL text has a span of that text.

use std::error::Error;
use std::fmt;

use pddl::Span;

/// An error with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Located<E> {
    /// The place, in the source of the domain or problem that was read.
    pub span: Span,
    /// The error.
    pub kind: E,
}

impl<E> Located<E> {
    /// An error at a place.
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

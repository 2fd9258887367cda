//! Places in the domain and in the problem that are linted.
//!
//! Lints do not know the ids of their files. They name the domain [`DOMAIN`] and the problem [`PROBLEM`];
//! [`Linter`](crate::Linter) replaces both at the end.

use diagnostics::{Place, SourceId, Span};
use pddl::FileKind;

/// The domain.
pub(crate) const DOMAIN: SourceId = SourceId(0);
/// The problem.
pub(crate) const PROBLEM: SourceId = SourceId(1);

/// A place in the domain.
pub(crate) fn domain(span: Span) -> Place {
    Place { source: DOMAIN, span }
}

/// A place in the problem.
pub(crate) fn problem(span: Span) -> Place {
    Place { source: PROBLEM, span }
}

/// A place in the file of that kind.
pub(crate) fn of_file(file: FileKind, span: Span) -> Place {
    match file {
        FileKind::Domain => domain(span),
        FileKind::Problem => problem(span),
    }
}

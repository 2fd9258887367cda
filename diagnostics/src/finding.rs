//! Findings across files: what is wrong, and where.
//!
//! Problem: `pddl::Diagnostic` speaks of one source; what is wrong with a project or a mission often lies
//! between two (a problem's domain is nowhere, a node has no sentence in `fr.toml`). Idea: number the sources;
//! a [`Place`] is a source and a span, and a [`Finding`] may have several. Rendering with colours and excerpts
//! is the edge's work; [`Sources::place`](crate::Sources::place) gives the plain line that tests and logs use.
//!
//! Codes: E01xx to W09xx of `pddl` and the lints; of missions E07xx shape of a TOML file, E08xx words, E09xx
//! scenarios, C01xx between the layers.

use serde::Serialize;

use crate::{Severity, SourceId, Span};

/// A place in some source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Which source.
    pub source: SourceId,
    /// Where in it.
    pub span: Span,
}

/// Something to tell an author. The code is for programs, the rest for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Stable code, `E0801`.
    pub code: &'static str,
    /// How bad.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// Where.
    pub place: Place,
    /// Other places, in any source, each with what it has to do with it.
    pub related: Vec<(Place, String)>,
    /// What would be right.
    pub help: Option<String>,
}

impl Finding {
    /// An error.
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code, severity: Severity::Error, message, place, related: Vec::new(), help: None }
    }

    /// A warning.
    pub fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, place, message) }
    }

    /// With advice.
    pub fn help(self, help: impl Into<String>) -> Self {
        self.help_if(Some(help.into()))
    }

    /// With advice, if there is any.
    pub fn help_if(mut self, help: Option<String>) -> Self {
        self.help = help;
        self
    }

    /// With another place.
    pub fn related(mut self, place: Place, message: impl Into<String>) -> Self {
        self.related.push((place, message.into()));
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

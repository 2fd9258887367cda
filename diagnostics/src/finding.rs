//! Findings across files: what is wrong, and where.
//!
//! Problem: a mistake in a project or a mission often lies between two sources (no file defines a problem's
//! domain, a node has no sentence in `fr.toml`). Idea: number the sources; a [`Place`] is a source and a
//! span, and a [`Finding`] may have several. The edge renders colours and excerpts;
//! [`Sources::place`](crate::Sources::place) gives the plain line that tests and logs use.
//!
//! Codes: E01xx to W09xx are those of `pddl` and the lints. Missions use E07xx for the shape of a TOML file,
//! E08xx for words, E09xx for scenarios, C01xx for conflicts between the layers.

use serde::Serialize;

use crate::{Severity, SourceId, Span};

/// A place in a source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Place {
    /// Which source.
    pub source: SourceId,
    /// Where in it.
    pub span: Span,
}

/// A message to an author. The code is for programs, the rest for people.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// Stable code, `E0801`; `None` for an answer at a place (there is no plan, this plan is invalid).
    pub code: Option<&'static str>,
    /// Its severity.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The place that it is about.
    pub place: Place,
    /// Other places, in any source, each with a note.
    pub related: Vec<(Place, String)>,
    /// How to correct it.
    pub help: Option<String>,
}

impl Finding {
    /// An error.
    pub fn error(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self { code: Some(code), ..Self::answer(place, message) }
    }

    /// An error that is an answer at a place, and has no code.
    pub fn answer(place: Place, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { code: None, severity: Severity::Error, message, place, related: Vec::new(), help: None }
    }

    /// A warning.
    pub fn warning(code: &'static str, place: Place, message: impl Into<String>) -> Self {
        Self { severity: Severity::Warning, ..Self::error(code, place, message) }
    }

    /// Adds advice.
    pub fn help(self, help: impl Into<String>) -> Self {
        self.help_if(Some(help.into()))
    }

    /// Adds advice, if given.
    pub fn help_if(mut self, help: Option<String>) -> Self {
        self.help = help;
        self
    }

    /// Adds another place with its note.
    pub fn related(mut self, place: Place, message: impl Into<String>) -> Self {
        self.related.push((place, message.into()));
        self
    }

    /// Whether it is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

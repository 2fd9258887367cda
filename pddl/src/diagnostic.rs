//! What is wrong with a source, where, and what would be right.
//!
//! A diagnostic is data: a kind with its fields, a span, and secondary spans. Codes are stable.
//! Rendering (colours, excerpts, JSON) is the edge's work.

use crate::Span;
use serde::Serialize;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The model is still meaningful.
    Warning,
    /// A language feature that is read but that no model holds yet.
    Unsupported,
    /// There is no model.
    Error,
}

/// Something to tell an author.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Diagnostic {
    /// Stable code, `E0101`.
    pub code: &'static str,
    /// How bad.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// Where.
    pub span: Span,
    /// Other places, each with what it has to do with it.
    pub labels: Vec<(Span, String)>,
    /// What would be right ("did you mean …", "expected …").
    pub help: Option<String>,
}

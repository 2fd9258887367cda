//! What is wrong with a source, where, and what would be right.
//!
//! A diagnostic is data: a [`DiagnosticKind`] with its fields, a span, and secondary spans. Codes are
//! stable: E for errors, W for warnings, U for language features that no model holds. Rendering
//! (colours, JSON) is the edge's work; `explain` says of each code what it means; [`Diagnostic::describe`] is the plain text that needs nothing.

mod describe;
mod explain;
mod explanation;
mod kind;

pub use explain::{UnknownCode, explain, explanations};
pub use explanation::{Explanation, MalformedExplanation};
pub use kind::{DiagnosticKind, FileKind, SymbolKind, UnsupportedFeature};

use diagnostics::{Severity, Span};
use serde::Serialize;
use serde::ser::SerializeStruct;

/// What a secondary place has to do with a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Label {
    /// Where the name was declared first.
    #[error("first declared here")]
    First,
    /// Where the variable got its type.
    #[error("declared here")]
    Declared,
    /// The list that should have ended before.
    #[error("opened here")]
    Opened,
    /// The last section of a definition that is not closed.
    #[error("unless it is one in this section that is not closed")]
    LastSection,
}

/// Something to tell an author.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, with what it is about.
    pub kind: DiagnosticKind,
    /// How bad.
    pub severity: Severity,
    /// Where.
    pub span: Span,
    /// Other places of the same source.
    pub labels: Vec<(Span, Label)>,
}

impl Diagnostic {
    /// A diagnostic without labels.
    pub fn new(span: Span, kind: DiagnosticKind) -> Self {
        Self { severity: kind.severity(), kind, span, labels: Vec::new() }
    }

    /// The same with a secondary place.
    #[must_use]
    pub fn with_label(mut self, span: Span, label: Label) -> Self {
        self.labels.push((span, label));
        self
    }

    /// Stable code, `E0101`.
    pub fn code(&self) -> &'static str {
        self.kind.code()
    }

    /// One sentence without a full stop.
    pub fn message(&self) -> String {
        self.kind.to_string()
    }

    /// What would be right ("did you mean …", "expected …").
    pub fn help(&self) -> Option<String> {
        self.kind.help()
    }
}

impl Serialize for Diagnostic {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let labels: Vec<(Span, String)> = self.labels.iter().map(|(s, l)| (*s, l.to_string())).collect();
        let mut fields = to.serialize_struct("Diagnostic", 6)?;
        fields.serialize_field("code", self.code())?;
        fields.serialize_field("severity", &self.severity)?;
        fields.serialize_field("message", &self.message())?;
        fields.serialize_field("span", &self.span)?;
        fields.serialize_field("labels", &labels)?;
        fields.serialize_field("help", &self.help())?;
        fields.end()
    }
}

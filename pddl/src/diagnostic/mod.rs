//! What is wrong with a source, where, and how to correct it.
//!
//! A diagnostic is data: a [`DiagnosticKind`] with its fields, a span, and secondary spans. Codes are
//! stable: E for errors, W for warnings, U for language features that are read but not modelled. The edge
//! renders colours and JSON; [`explain`] says what each code means; [`Diagnostic::describe`] is plain text
//! without further data.

mod describe;
mod explain;
mod kind;

pub use explain::{explain, explanations};
pub use kind::{DiagnosticKind, FileKind, SymbolKind, UnsupportedFeature};

use diagnostics::{Severity, Span};
use serde::Serialize;
use serde::ser::SerializeStruct;

/// The relation of a secondary place to a diagnostic.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Label {
    /// Where the name was declared first.
    #[error("first declared here")]
    First,
    /// Where the variable got its type.
    #[error("declared here")]
    Declared,
    /// The list that should have ended earlier.
    #[error("opened here")]
    Opened,
    /// The last section of a definition that is not closed.
    #[error("or a list in this section is not closed")]
    LastSection,
}

/// A message to an author.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// What is wrong, with the names and values involved.
    pub kind: DiagnosticKind,
    /// Its severity.
    pub severity: Severity,
    /// The place that it is about.
    pub span: Span,
    /// Other places of the same source.
    pub labels: Vec<(Span, Label)>,
}

impl Diagnostic {
    /// A diagnostic without labels.
    pub fn new(span: Span, kind: DiagnosticKind) -> Self {
        Self { severity: kind.severity(), kind, span, labels: Vec::new() }
    }

    /// Adds a secondary place.
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

    /// How to correct it ("did you mean …", "expected …").
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

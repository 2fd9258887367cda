//! A diagnostic as plain text: `file:line:column: error[E0202]: message`, the line, carets.

use std::fmt::Write as _;

use super::Diagnostic;
use diagnostics::{Finding, Place, Source, SourceId, Span};

impl Diagnostic {
    /// Plain text for a terminal or a log; several lines, the last one ends with a line end.
    pub fn describe(&self, source: &Source) -> String {
        let mut text = String::new();
        let place = source.line_column(self.span.start);
        let severity = self.severity.word();
        let (file, code, kind) = (source.name(), self.code(), &self.kind);
        let _ = writeln!(text, "{file}:{}:{}: {severity}[{code}]: {kind}", place.line, place.column);
        text += &source.excerpt(self.span, "");
        for (span, label) in &self.labels {
            text += &source.excerpt(*span, &label.to_string());
        }
        if let Some(help) = self.help() {
            let _ = writeln!(text, "  = {help}");
        }
        text
    }

    /// As a finding of the source with the id `source`.
    pub fn finding(&self, source: SourceId) -> Finding {
        let place = |span: Span| Place { source, span };
        let related = self.labels.iter().map(|(span, label)| (place(*span), label.to_string())).collect();
        Finding {
            code: Some(self.code()),
            severity: self.severity,
            message: self.message(),
            place: place(self.span),
            related,
            help: self.help(),
        }
    }
}

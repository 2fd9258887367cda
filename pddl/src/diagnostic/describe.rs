//! A diagnostic as plain text: `file:line:column: error[E0202]: message`, the line, carets.

use std::fmt::Write as _;

use super::{Diagnostic, Severity};
use crate::{Source, Span};

/// Longest excerpt of a line, in characters.
const WIDTH: usize = 160;

impl Diagnostic {
    /// Plain text for a terminal or a log; several lines, the last one ends with a line end.
    pub fn describe(&self, source: &Source) -> String {
        let mut text = String::new();
        let place = source.line_column(self.span.start);
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Unsupported => "unsupported",
            Severity::Error => "error",
        };
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
}

impl Source {
    /// The line where `span` starts, and carets under its part on that line, with a note beside them. As plain
    /// text of two lines; the last one ends with a line end.
    pub fn excerpt(&self, span: Span, note: &str) -> String {
        let place = self.line_column(span.start);
        let line = self.line(place.line);
        let column = place.column as usize - 1;
        // A line of a generated file may be megabytes: the window moves to where the span is.
        let fits = line.len() <= WIDTH;
        let skip = if fits { 0 } else { column.saturating_sub(WIDTH / 2) };
        let shown: String =
            line.chars().skip(skip).take(WIDTH).map(|c| if c.is_control() { ' ' } else { c }).collect();
        let width = self.slice(span).lines().next().map_or(1, |part| part.chars().count());
        let room = shown.chars().count().saturating_sub(column - skip).max(1);
        let number = place.line.to_string();
        let margin = " ".repeat(number.len());
        let (indent, carets) = (" ".repeat(column - skip), "^".repeat(width.clamp(1, room)));
        let mut text = String::new();
        let _ = writeln!(text, "{number} | {}", shown.trim_end());
        let _ = writeln!(text, "{}", format!("{margin} | {indent}{carets} {note}").trim_end());
        text
    }
}

//! Diagnostics as text with an excerpt, or as JSON.
//!
//! The crates below say what is wrong as data with spans; here it gets a file, a line, a column and the
//! lines around it. As JSON a diagnostic is one line:
//!
//! ```json
//! {"kind": "diagnostic", "severity": "error", "code": "E0101", "message": "…",
//!  "place": {"file": "p.pddl", "line": 3, "column": 7, "end_line": 3, "end_column": 12},
//!  "labels": [{"message": "…", "place": {…}}], "help": null}
//! ```
//!
//! Lines and columns start at 1, columns count characters, ends are exclusive. `code`, `place` and
//! `help` may be null. Fields may be added; none will be renamed.

use crate::console::{Console, Form};
use ariadne::{CharSet, Color, Config, IndexType, Label, Report, ReportKind};
use pddl::{Diagnostic, Severity, Source, Span};
use serde::Serialize;
use std::borrow::Cow;
use std::ops::Range;

/// More than this for one file would only scroll the first ones away.
pub(crate) const MOST_PER_FILE: usize = 50;

/// `1 error`, `2 errors`.
pub(crate) fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// A span with its source.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) source: &'a Source,
    pub(crate) span: Span,
}

/// What the edge shows, whoever found it.
pub(crate) struct Message<'a> {
    pub(crate) severity: Severity,
    pub(crate) code: Option<&'static str>,
    pub(crate) text: String,
    pub(crate) at: Option<At<'a>>,
    pub(crate) labels: Vec<(At<'a>, String)>,
    pub(crate) help: Option<String>,
}

impl<'a> Message<'a> {
    /// An error without a place.
    pub(crate) fn error(text: impl Into<String>) -> Self {
        Self {
            severity: Severity::Error,
            code: None,
            text: text.into(),
            at: None,
            labels: Vec::new(),
            help: None,
        }
    }

    /// The same at a place.
    pub(crate) fn at(mut self, source: &'a Source, span: Span) -> Self {
        self.at = Some(At { source, span });
        self
    }

    fn of(source: &'a Source, diagnostic: &Diagnostic) -> Self {
        Self {
            severity: diagnostic.severity,
            code: Some(diagnostic.code()),
            text: diagnostic.message(),
            at: Some(At { source, span: diagnostic.span }),
            labels: diagnostic
                .labels
                .iter()
                .map(|(span, text)| (At { source, span: *span }, text.to_string()))
                .collect(),
            help: diagnostic.help(),
        }
    }

    /// Shows it.
    pub(crate) fn show(&self, console: &mut Console<'_>) {
        match console.form() {
            Form::Text => {
                let text = self.text(console.colour());
                console.block(&text);
            }
            Form::Json => console.record(&self.record()),
        }
    }

    fn text(&self, colour: bool) -> String {
        let Some(at) = self.at else {
            let help = self.help.as_ref().map(|help| format!("  help: {help}\n")).unwrap_or_default();
            return format!("{}: {}\n{help}", word(self.severity), self.text);
        };
        let places = || std::iter::once(at).chain(self.labels.iter().map(|(at, _)| *at));
        if places().any(is_long) {
            return self.plain(at);
        }
        let kind = match self.severity {
            Severity::Error => ReportKind::Error,
            Severity::Warning => ReportKind::Warning,
            Severity::Unsupported => ReportKind::Custom("Unsupported", Color::Yellow),
        };
        let config = Config::default()
            .with_color(colour)
            .with_char_set(CharSet::Unicode)
            .with_index_type(IndexType::Byte);
        let primary = (at.source.name().to_owned(), bytes(at));
        let mut report = Report::build(kind, primary.clone()).with_config(config).with_message(&self.text);
        if let Some(code) = self.code {
            report = report.with_code(code);
        }
        if let Some(help) = &self.help {
            report = report.with_help(help);
        }
        if self
            .labels
            .iter()
            .all(|(place, _)| place.source.name() != at.source.name() || place.span != at.span)
        {
            report = report.with_label(Label::new(primary).with_message("here"));
        }
        let mut texts = vec![(at.source.name().to_owned(), harmless(at.source.text()))];
        for (order, (place, text)) in (1..).zip(&self.labels) {
            let span = (place.source.name().to_owned(), bytes(*place));
            report = report.with_label(Label::new(span).with_message(text).with_order(order));
            if texts.iter().all(|(name, _)| name != place.source.name()) {
                texts.push((place.source.name().to_owned(), harmless(place.source.text())));
            }
        }
        let mut text = Vec::new();
        match report.finish().write(ariadne::sources(texts), &mut text) {
            Ok(()) => {
                let mut text = String::from_utf8_lossy(&text).into_owned();
                if !colour {
                    // The name of a kind of our own is coloured whatever the configuration says.
                    text = text.replace("\u{1b}[33m", "").replace("\u{1b}[0m", "");
                }
                text.lines().map(|line| format!("{}\n", line.trim_end())).collect()
            }
            Err(_) => format!("{}: {}\n", word(self.severity), self.text),
        }
    }

    /// A head, places, and pieces of their lines.
    fn plain(&self, at: At<'_>) -> String {
        let code = self.code.map(|code| format!("[{code}] ")).unwrap_or_default();
        let mut text = format!("{code}{}: {}\n", word(self.severity), self.text);
        let labels = self.labels.iter().map(|(at, note)| (*at, note.as_str()));
        for (At { source, span }, note) in std::iter::once((at, "here")).chain(labels) {
            let place = source.line_column(span.start);
            let column = place.column as usize - 1;
            let skip = column.saturating_sub(WINDOW / 2);
            let shown: String = source.line(place.line).chars().skip(skip).take(WINDOW).collect();
            let shown = harmless(&shown).replace('\t', " ");
            let (before, after) = (" ".repeat(column - skip), if skip > 0 { "… " } else { "" });
            text += &format!("   {}:{}:{}\n", source.name(), place.line, place.column);
            text += &format!("   {after}{}\n", shown.trim_end());
            text += &format!("   {}{before}^ {note}\n", " ".repeat(after.chars().count()));
        }
        if let Some(help) = &self.help {
            text += &format!("   Help: {help}\n");
        }
        text
    }

    fn record(&self) -> DiagnosticRecord<'_> {
        DiagnosticRecord {
            kind: "diagnostic",
            severity: self.severity,
            code: self.code,
            message: &self.text,
            place: self.at.map(PlaceRecord::of),
            labels: self
                .labels
                .iter()
                .map(|(at, message)| LabelRecord { message, place: PlaceRecord::of(*at) })
                .collect(),
            help: self.help.as_deref(),
        }
    }
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Warning => "Warning",
        Severity::Unsupported => "Unsupported",
        Severity::Error => "Error",
    }
}

/// How much of a long line is shown, in characters.
const WINDOW: usize = 100;

/// Longest line that is shown whole, and longest text that is drawn with frames (which looks at all of it every
/// time), both in bytes.
const LONGEST: (usize, usize) = (2_000, 4_000_000);

fn is_long(at: At<'_>) -> bool {
    let lines = [at.span.start, at.span.end].map(|offset| at.source.line_column(offset).line);
    at.source.text().len() > LONGEST.1 || lines.iter().any(|&line| at.source.line(line).len() > LONGEST.0)
}

/// A text that a terminal only shows: control characters, which are a byte each, become `?`.
fn harmless(text: &str) -> Cow<'_, str> {
    let harmful = |c: char| c.is_ascii_control() && !matches!(c, '\n' | '\r' | '\t');
    if text.contains(harmful) { Cow::Owned(text.replace(harmful, "?")) } else { Cow::Borrowed(text) }
}

/// The span inside its text, on the boundaries of characters, and never empty where there is a character.
fn bytes(at: At<'_>) -> Range<usize> {
    let text = at.source.text();
    let mut start = at.span.range().start.min(text.len());
    while !text.is_char_boundary(start) {
        start -= 1;
    }
    let mut end = at.span.range().end.clamp(start, text.len());
    while !text.is_char_boundary(end) {
        end += 1;
    }
    if start == end
        && let Some(next) = text[start..].chars().next()
    {
        end += next.len_utf8();
    }
    start..end
}

/// Shows all diagnostics of a source, and answers the worst severity.
pub(crate) fn show_all(
    source: &Source,
    diagnostics: &[Diagnostic],
    console: &mut Console<'_>,
) -> Option<Severity> {
    let shown = if console.form() == Form::Json { diagnostics.len() } else { MOST_PER_FILE };
    for diagnostic in diagnostics.iter().take(shown) {
        Message::of(source, diagnostic).show(console);
    }
    if diagnostics.len() > shown {
        console.note(&format!("… and {} more in {}", diagnostics.len() - shown, source.name()));
    }
    diagnostics.iter().map(|d| d.severity).max()
}

/// A place as JSON.
#[derive(Clone, Debug, Serialize)]
pub(crate) struct PlaceRecord {
    file: String,
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
}

impl PlaceRecord {
    pub(crate) fn of(at: At<'_>) -> Self {
        let (start, end) = (at.source.line_column(at.span.start), at.source.line_column(at.span.end));
        Self {
            file: at.source.name().to_owned(),
            line: start.line,
            column: start.column,
            end_line: end.line,
            end_column: end.column,
        }
    }
}

#[derive(Serialize)]
struct LabelRecord<'a> {
    message: &'a str,
    place: PlaceRecord,
}

#[derive(Serialize)]
struct DiagnosticRecord<'a> {
    kind: &'static str,
    severity: Severity,
    code: Option<&'static str>,
    message: &'a str,
    place: Option<PlaceRecord>,
    labels: Vec<LabelRecord<'a>>,
    help: Option<&'a str>,
}

#[cfg(test)]
mod tests {
    use super::{At, Message, bytes};
    use pddl::{Source, Span};

    #[test]
    fn of_a_long_line_a_piece_is_shown() {
        let source = Source::new("x", format!("a\n{}(p){}", "(and ".repeat(1000), ")".repeat(1000)));
        let shown = Message::error("too deep").at(&source, Span::new(5002, 6005)).text(false);
        expect_test::expect![[r#"
            Error: too deep
               x:2:5001
               … (and (and (and (and (and (and (and (and (and (and (p))))))))))))))))))))))))))))))))))))))))))))))))
                                                                   ^ here
        "#]]
        .assert_eq(&shown);
    }

    #[test]
    fn spans_of_any_kind_are_shown() {
        for text in ["", "é", "(a\n b)", "\u{1F600}x"] {
            let source = Source::new("x", text);
            for start in 0..8 {
                for end in start..9 {
                    let span = Span::new(start, end);
                    let range = bytes(At { source: &source, span });
                    assert!(text.get(range).is_some());
                    let shown = Message::error("nothing").at(&source, span).text(false);
                    assert!(shown.starts_with("Error: nothing"), "{shown}");
                }
            }
        }
    }
}

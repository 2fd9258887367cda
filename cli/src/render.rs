//! Diagnostics as text with an excerpt, or as JSON.
//!
//! The crates below report findings as data with spans. This module adds the file, the line, the column and the
//! surrounding lines. As JSON a diagnostic is one line:
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
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::{Severity, Source, Span};
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// The most findings that are shown of one file; more would scroll the first ones away.
const MOST_PER_FILE: usize = 50;

/// `1 error`, `2 errors`.
pub(crate) fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// Shows an error that has no place in a text: a missing file, an argument.
pub(crate) fn error(text: impl Into<String>, console: &mut Console<'_>) {
    error_with_help(text, None, console);
}

/// Shows an error that has no place in a text, with advice.
pub(crate) fn error_with_help(text: impl Into<String>, help: Option<&str>, console: &mut Console<'_>) {
    let text = text.into();
    let advice = help.map(|help| format!("  help: {help}\n")).unwrap_or_default();
    console.block(&format!("{}: {text}\n{advice}", word(Severity::Error)));
    console.record(&DiagnosticRecord {
        kind: "diagnostic",
        severity: Severity::Error,
        code: None,
        message: &text,
        place: None,
        labels: Vec::new(),
        help,
    });
}

/// Shows a finding at its places.
pub(crate) fn show(sources: &Sources, finding: &Finding, console: &mut Console<'_>) {
    match console.form() {
        Form::Text => {
            let text = text(sources, finding, console.colour());
            console.block(&text);
        }
        Form::Json => console.record(&record(sources, finding)),
    }
}

/// Shows the first [`MOST_PER_FILE`] findings of each file and the number of the others; as JSON,
/// shows all of them. Returns the worst severity.
pub(crate) fn show_all(
    sources: &Sources,
    findings: &[Finding],
    console: &mut Console<'_>,
) -> Option<Severity> {
    let mut counts: BTreeMap<SourceId, usize> = BTreeMap::new();
    for finding in findings {
        let count = counts.entry(finding.place.source).or_default();
        *count += 1;
        if *count <= MOST_PER_FILE || console.form() == Form::Json {
            show(sources, finding, console);
        }
    }
    for (id, count) in counts.into_iter().filter(|(_, count)| *count > MOST_PER_FILE) {
        console.note(&format!("… and {} more in {}", count - MOST_PER_FILE, sources[id].name()));
    }
    findings.iter().map(|finding| finding.severity).max()
}

/// A span with its source.
#[derive(Clone, Copy)]
pub(crate) struct At<'a> {
    pub(crate) source: &'a Source,
    pub(crate) span: Span,
}

fn at(sources: &Sources, place: Place) -> At<'_> {
    At { source: &sources[place.source], span: place.span }
}

/// Renders with frames, unless a text is too long for them.
fn text(sources: &Sources, finding: &Finding, colour: bool) -> String {
    let primary = at(sources, finding.place);
    let labels: Vec<(At<'_>, &str)> =
        finding.related.iter().map(|(place, text)| (at(sources, *place), text.as_str())).collect();
    if is_long(primary) || labels.iter().any(|(at, _)| is_long(*at)) {
        return plain(finding, primary, &labels);
    }
    let kind = match finding.severity {
        Severity::Error => ReportKind::Error,
        Severity::Warning => ReportKind::Warning,
        Severity::Unsupported => ReportKind::Custom("Unsupported", Color::Yellow),
    };
    let config =
        Config::default().with_color(colour).with_char_set(CharSet::Unicode).with_index_type(IndexType::Byte);
    let span = (primary.source.name().to_owned(), bytes(primary));
    let mut report = Report::build(kind, span.clone()).with_config(config).with_message(&finding.message);
    if let Some(code) = finding.code {
        report = report.with_code(code);
    }
    if let Some(help) = &finding.help {
        report = report.with_help(help);
    }
    if labels.iter().all(|(at, _)| at.source.name() != primary.source.name() || at.span != primary.span) {
        report = report.with_label(Label::new(span).with_message("here"));
    }
    let mut texts = vec![(primary.source.name().to_owned(), harmless(primary.source.text()))];
    for (order, (at, text)) in (1..).zip(&labels) {
        let span = (at.source.name().to_owned(), bytes(*at));
        report = report.with_label(Label::new(span).with_message(text).with_order(order));
        if texts.iter().all(|(name, _)| name != at.source.name()) {
            texts.push((at.source.name().to_owned(), harmless(at.source.text())));
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
        Err(_) => format!("{}: {}\n", word(finding.severity), finding.message),
    }
}

/// Renders without frames: a head, the places, and the parts of their lines around them.
fn plain(finding: &Finding, primary: At<'_>, labels: &[(At<'_>, &str)]) -> String {
    let code = finding.code.map(|code| format!("[{code}] ")).unwrap_or_default();
    let mut text = format!("{code}{}: {}\n", word(finding.severity), finding.message);
    for (At { source, span }, note) in std::iter::once((primary, "here")).chain(labels.iter().copied()) {
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
    if let Some(help) = &finding.help {
        text += &format!("   Help: {help}\n");
    }
    text
}

fn record<'a>(sources: &Sources, finding: &'a Finding) -> DiagnosticRecord<'a> {
    let place = |place: Place| PlaceRecord::of(at(sources, place));
    DiagnosticRecord {
        kind: "diagnostic",
        severity: finding.severity,
        code: finding.code,
        message: &finding.message,
        place: Some(place(finding.place)),
        labels: finding
            .related
            .iter()
            .map(|(at, message)| LabelRecord { message, place: place(*at) })
            .collect(),
        help: finding.help.as_deref(),
    }
}

fn word(severity: Severity) -> &'static str {
    match severity {
        Severity::Warning => "Warning",
        Severity::Unsupported => "Unsupported",
        Severity::Error => "Error",
    }
}

/// The most characters of a long line that are shown.
const WINDOW: usize = 100;

/// In bytes: the longest line that is shown completely, and the longest text that is drawn with
/// frames (each frame reads all of it).
const LONGEST: (usize, usize) = (2_000, 4_000_000);

fn is_long(at: At<'_>) -> bool {
    let lines = [at.span.start, at.span.end].map(|offset| at.source.line_column(offset).line);
    at.source.text().len() > LONGEST.1 || lines.iter().any(|&line| at.source.line(line).len() > LONGEST.0)
}

/// A text for terminals only: each control character, which is one byte, becomes `?`.
fn harmless(text: &str) -> Cow<'_, str> {
    let harmful = |c: char| c.is_ascii_control() && !matches!(c, '\n' | '\r' | '\t');
    if text.contains(harmful) { Cow::Owned(text.replace(harmful, "?")) } else { Cow::Borrowed(text) }
}

/// The span clamped to its text and to character boundaries. It is empty only at the end of the text.
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
    use super::{At, bytes, text};
    use diagnostics::{Finding, Place, Sources};
    use pddl::{Source, Span};

    fn shown(source: Source, span: Span, message: &str) -> String {
        let (sources, source) = Sources::of(source);
        text(&sources, &Finding::answer(Place { source, span }, message), false)
    }

    #[test]
    fn of_a_long_line_a_piece_is_shown() {
        let source = Source::new("x", format!("a\n{}(p){}", "(and ".repeat(1000), ")".repeat(1000)));
        let text = shown(source, Span::new(5002, 6005), "too deep");
        expect_test::expect![[r#"
            Error: too deep
               x:2:5001
               … (and (and (and (and (and (and (and (and (and (and (p))))))))))))))))))))))))))))))))))))))))))))))))
                                                                   ^ here
        "#]]
        .assert_eq(&text);
    }

    #[test]
    fn spans_of_any_kind_are_shown() {
        for text in ["", "é", "(a\n b)", "\u{1F600}x"] {
            for start in 0..8 {
                for end in start..9 {
                    let span = Span::new(start, end);
                    let source = Source::new("x", text);
                    let range = bytes(At { source: &source, span });
                    assert!(text.get(range).is_some());
                    let shown = shown(source, span, "nothing");
                    assert!(shown.starts_with("Error: nothing"), "{shown}");
                }
            }
        }
    }
}

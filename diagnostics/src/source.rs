//! Sources and places in them.
//!
//! A [`Span`] is a byte range of one file; a [`Source`] turns it into lines, columns and text.
//! Spans are 8 bytes so that every node of every model can carry one. Columns count characters,
//! lines and columns start at 1, as editors show them.

use std::fmt::Write as _;

use serde::Serialize;

/// Longest excerpt of a line, in characters.
const WIDTH: usize = 160;

/// A half-open byte range `start..end` of one source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct Span {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// The range `start..end`.
    pub const fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }

    /// The smallest span that covers both.
    pub fn to(self, other: Self) -> Self {
        Self::new(self.start.min(other.start), self.end.max(other.end))
    }

    /// As indices into the text.
    pub fn range(self) -> std::ops::Range<usize> {
        self.start as usize..self.end as usize
    }
}

/// Line and column, both from 1; columns count characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct LineColumn {
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

/// The number of a source in a project or a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct SourceId(pub u32);

impl SourceId {
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A named text. Diagnostics show the name, usually a path.
#[derive(Clone, Debug)]
pub struct Source {
    name: String,
    text: String,
    line_starts: Vec<u32>,
}

impl Source {
    /// Longest text that spans can address, in bytes.
    pub const MAX_BYTES: usize = u32::MAX as usize;

    /// Indexes the lines of `text`.
    ///
    /// # Panics
    /// If `text` is longer than [`Source::MAX_BYTES`]; readers check first.
    pub fn new(name: impl Into<String>, text: impl Into<String>) -> Self {
        let text = text.into();
        assert!(text.len() <= Self::MAX_BYTES, "a source is shorter than 4 GiB");
        let ends = (1u32..).zip(text.bytes()).filter(|&(_, b)| b == b'\n').map(|(next, _)| next);
        let line_starts = std::iter::once(0).chain(ends).collect();
        Self { name: name.into(), text, line_starts }
    }

    /// Reads bytes as [`Source::decode`] does.
    ///
    /// # Panics
    /// Like [`Source::new`].
    pub fn from_bytes(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self::new(name, Self::decode(bytes))
    }

    /// Decodes UTF-8 or, if the bytes are not UTF-8, Latin-1, the encoding of old competition files. Names
    /// then appear as their authors wrote them. A byte order mark is removed.
    pub fn decode(bytes: Vec<u8>) -> String {
        let mut text =
            String::from_utf8(bytes).unwrap_or_else(|e| e.into_bytes().into_iter().map(char::from).collect());
        if text.starts_with('\u{feff}') {
            text.drain(..'\u{feff}'.len_utf8());
        }
        text
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The whole text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The text of a span (empty if the span is out of range).
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.range()).unwrap_or("")
    }

    /// The text of a line (from 1) without its line end; empty if the line does not exist.
    pub fn line(&self, line: u32) -> &str {
        let Some(&start) = (line as usize).checked_sub(1).and_then(|i| self.line_starts.get(i)) else {
            return "";
        };
        let end = self.line_starts.get(line as usize).map_or(self.text.len(), |&e| e as usize);
        self.text.get(start as usize..end).unwrap_or("").trim_end_matches(['\n', '\r'])
    }

    /// Line and column of a byte offset.
    pub fn line_column(&self, offset: u32) -> LineColumn {
        let line = self.line_starts.partition_point(|&s| s <= offset).max(1) - 1;
        let start = self.line_starts[line] as usize;
        let end = (offset as usize).min(self.text.len());
        let column = self.text.get(start..end).map_or(0, |t| t.chars().count());
        let from_one = |n: usize| u32::try_from(n + 1).unwrap_or(u32::MAX);
        LineColumn { line: from_one(line), column: from_one(column) }
    }
}

impl Source {
    /// The line where `span` starts, with carets under the span and a note beside them. Plain text of two
    /// lines; the last one ends with a line end.
    pub fn excerpt(&self, span: Span, note: &str) -> String {
        let place = self.line_column(span.start);
        let line = self.line(place.line);
        let column = place.column as usize - 1;
        // A line of a generated file may be megabytes long: the window moves to the span.
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

#[cfg(test)]
mod tests {
    use super::Source;

    #[test]
    fn latin_1_is_read() {
        assert_eq!(Source::decode(b"(at caf\xe9)".to_vec()), "(at café)");
        assert_eq!(Source::decode("(at café)".as_bytes().to_vec()), "(at café)");
        assert_eq!(Source::decode(b"\xef\xbb\xbf(a)".to_vec()), "(a)");
    }
}

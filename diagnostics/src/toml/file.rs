//! Reads one TOML file.

use ::toml::de::DeTable;

use super::reader::span;
use super::{Reader, Table};
use crate::{Finding, Source, SourceId, Span};

impl<'a> Reader<'a> {
    /// Parses `source` and hands its root table to `read`. Syntax errors become findings, and the entries
    /// that could be parsed are read all the same.
    pub fn read<T>(
        id: SourceId,
        source: &'a Source,
        read: impl FnOnce(&mut Self, Table<'_>) -> T,
    ) -> (T, Vec<Finding>) {
        let mut reader = Self { source: id, text: source.text(), findings: Vec::new() };
        let (root, errors) = DeTable::parse_recoverable(source.text());
        let broken = !errors.is_empty();
        for error in errors {
            let span = error.span().map_or(Span::default(), span);
            reader.error("E0701", span, format!("this is not TOML: {}", error.message().replace('\n', ", ")));
        }
        let model = read(&mut reader, Table::new("", Span::default(), root.get_ref()));
        if broken {
            // Missing entries follow from the syntax errors, so only those are reported.
            reader.findings.retain(|f| f.code == Some("E0701"));
        }
        (model, reader.findings)
    }
}

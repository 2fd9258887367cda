//! Numbered sources, and places in them as plain lines.

use std::fmt::Write as _;
use std::sync::Arc;

use crate::{Finding, Place, Source, SourceId, Span};

/// Numbered sources.
#[derive(Clone, Debug, Default)]
pub struct Sources(Vec<Arc<Source>>);

impl Sources {
    /// An empty collection.
    pub fn new() -> Self {
        Self::default()
    }

    /// Only this one, with its id.
    pub fn of(source: Source) -> (Self, SourceId) {
        let mut sources = Self::new();
        let id = sources.push(source);
        (sources, id)
    }

    /// Adds one.
    pub fn push(&mut self, source: Source) -> SourceId {
        let id = SourceId(u32::try_from(self.0.len()).expect("there are fewer than 2^32 files"));
        self.0.push(Arc::new(source));
        id
    }

    /// Replaces the text of a source.
    pub fn replace(&mut self, id: SourceId, source: Source) {
        self.0[id.index()] = Arc::new(source);
    }

    /// The first place of a source.
    pub fn start_of(source: SourceId) -> Place {
        Place { source, span: Span::default() }
    }

    /// All, with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (SourceId, &Source)> {
        (0..).map(SourceId).zip(self.0.iter().map(|source| &**source))
    }

    /// A source as a shared pointer.
    pub fn shared(&self, id: SourceId) -> Arc<Source> {
        Arc::clone(&self.0[id.index()])
    }

    /// `path:line:column`.
    pub fn place(&self, place: Place) -> String {
        let source = &self.0[place.source.index()];
        let at = source.line_column(place.span.start);
        format!("{}:{}:{}", source.name(), at.line, at.column)
    }

    /// A finding in plain lines: place, severity, code, message, then other places and the advice.
    pub fn describe(&self, finding: &Finding) -> String {
        let severity = finding.severity.word();
        let place = self.place(finding.place);
        let code = finding.code.map(|code| format!("[{code}]")).unwrap_or_default();
        let mut text = format!("{place}: {severity}{code}: {}\n", finding.message);
        for (place, message) in &finding.related {
            let _ = writeln!(text, "  {}: {message}", self.place(*place));
        }
        if let Some(help) = &finding.help {
            let _ = writeln!(text, "  help: {help}");
        }
        text
    }
}

impl std::ops::Index<SourceId> for Sources {
    type Output = Source;
    fn index(&self, id: SourceId) -> &Source {
        &self.0[id.index()]
    }
}

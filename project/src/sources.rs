//! Texts by number, and places in them as plain lines.

use std::fmt::Write as _;
use std::sync::Arc;

use pddl::model::{Idx, IndexVec};
use pddl::{Severity, Source, Span};
use serde::Serialize;

use crate::{Finding, Place};

/// A text of a project or a mission.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize)]
pub struct SourceId(pub u32);

impl Idx for SourceId {
    fn from_index(index: usize) -> Self {
        Self(u32::try_from(index).expect("there are fewer than 2^32 files"))
    }
    fn index(self) -> usize {
        self.0 as usize
    }
}

/// Texts by number.
#[derive(Clone, Debug, Default)]
pub struct Sources(IndexVec<SourceId, Arc<Source>>);

impl Sources {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds one.
    pub fn push(&mut self, source: Source) -> SourceId {
        self.0.push(Arc::new(source))
    }

    /// Puts another text in the place of one.
    pub(crate) fn replace(&mut self, id: SourceId, source: Source) {
        self.0[id] = Arc::new(source);
    }

    /// The first place of the source of that id.
    pub fn start_of(source: SourceId) -> Place {
        Place { source, span: Span::default() }
    }

    /// All, with their ids.
    pub fn iter(&self) -> impl Iterator<Item = (SourceId, &Source)> {
        self.0.enumerate().map(|(id, s)| (id, &**s))
    }

    /// The source of that id, to keep.
    pub fn shared(&self, id: SourceId) -> Arc<Source> {
        Arc::clone(&self.0[id])
    }

    /// `path:line:column`.
    pub fn place(&self, place: Place) -> String {
        let source = &self.0[place.source];
        let at = source.line_column(place.span.start);
        format!("{}:{}:{}", source.name(), at.line, at.column)
    }

    /// A finding in plain lines: place, severity, code, message, then other places and the advice.
    pub fn describe(&self, finding: &Finding) -> String {
        let severity = match finding.severity {
            Severity::Warning => "warning",
            Severity::Unsupported => "unsupported",
            Severity::Error => "error",
        };
        let place = self.place(finding.place);
        let mut text = format!("{place}: {severity}[{}]: {}\n", finding.code, finding.message);
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
        &self.0[id]
    }
}

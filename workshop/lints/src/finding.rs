//! What a lint has found, as data.

use std::fmt::Write as _;

use pddl::{FileKind, Source, Span};

use crate::Lint;

/// A place in the domain or in the problem that is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// In which of the two files.
    pub file: FileKind,
    /// Where in it.
    pub span: Span,
}

impl Place {
    /// In the domain.
    pub fn domain(span: Span) -> Self {
        Self { file: FileKind::Domain, span }
    }

    /// In the problem.
    pub fn problem(span: Span) -> Self {
        Self { file: FileKind::Problem, span }
    }
}

/// A span's text becomes another one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Edit {
    /// What is replaced; empty to insert.
    pub place: Place,
    /// By what; empty to remove.
    pub text: String,
}

/// A way to mend it that keeps the meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What it does, in a few words.
    pub title: String,
    /// Edits that do not overlap.
    pub edits: Vec<Edit>,
}

/// A modelling mistake and its place.
#[derive(Clone, Debug)]
pub struct Finding {
    /// Of which kind.
    pub lint: &'static Lint,
    /// Where.
    pub place: Place,
    /// One sentence without a full stop.
    pub message: String,
    /// Other places that it is about.
    pub labels: Vec<(Place, String)>,
    /// What would be right.
    pub help: Option<String>,
    /// How a machine can mend it.
    pub fix: Option<Fix>,
}

impl Finding {
    /// A finding without labels, help and fix.
    pub fn new(lint: &'static Lint, place: Place, message: impl Into<String>) -> Self {
        Self { lint, place, message: message.into(), labels: Vec::new(), help: None, fix: None }
    }

    /// The same with another place.
    #[must_use]
    pub fn label(mut self, place: Place, text: impl Into<String>) -> Self {
        self.labels.push((place, text.into()));
        self
    }

    /// The same with what would be right.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The same with a way to mend it.
    #[must_use]
    pub fn fix(mut self, title: impl Into<String>, edits: Vec<Edit>) -> Self {
        self.fix = Some(Fix { title: title.into(), edits });
        self
    }

    /// Plain text for a terminal or a log; several lines, the last one ends with a line end.
    pub fn describe(&self, domain: &Source, problem: Option<&Source>) -> String {
        let source = |place: Place| match place.file {
            FileKind::Domain => domain,
            FileKind::Problem => problem.unwrap_or(domain),
        };
        let at = source(self.place);
        let position = at.line_column(self.place.span.start);
        let (line, column) = (position.line, position.column);
        let (code, name) = (self.lint.code(), self.lint.name);
        let mut text = format!("{}:{line}:{column}: warning[{code}]: {} ({name})\n", at.name(), self.message);
        text += &at.excerpt(self.place.span, "");
        for (place, note) in &self.labels {
            text += &source(*place).excerpt(place.span, note);
        }
        if let Some(help) = &self.help {
            let _ = writeln!(text, "  = {help}");
        }
        if let Some(fix) = &self.fix {
            let _ = writeln!(text, "  = fix: {}", fix.title);
        }
        text
    }
}

/// Where lints put what they find.
#[derive(Debug, Default)]
pub(crate) struct Findings(pub(crate) Vec<Finding>);

impl Findings {
    pub(crate) fn report(&mut self, finding: Finding) {
        self.0.push(finding);
    }
}

//! A lint's finding, with edits that mend the mistake.

use diagnostics::{Finding, Place, SourceId};

/// Edits that mend a mistake and keep the meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What they do, in a few words.
    pub title: String,
    /// Each place and its new text: an empty place to insert, an empty text to remove. They do not overlap.
    pub edits: Vec<(Place, String)>,
}

/// A finding of a lint.
#[derive(Clone, Debug)]
pub struct Linted {
    /// The finding, a warning.
    pub finding: Finding,
    /// The lint's name, for a comment that silences it.
    pub lint: &'static str,
    /// Edits that mend it.
    pub fix: Option<Fix>,
}

impl Linted {
    /// The code of its lint.
    pub(crate) fn code(&self) -> &'static str {
        self.finding.code.expect("a lint has a code")
    }

    /// Adds another place.
    #[must_use]
    pub(crate) fn label(mut self, place: Place, text: impl Into<String>) -> Self {
        self.finding = self.finding.related(place, text);
        self
    }

    /// Adds advice.
    #[must_use]
    pub(crate) fn help(mut self, help: impl Into<String>) -> Self {
        self.finding = self.finding.help(help);
        self
    }

    /// Adds edits. Their title is the advice where there is no other.
    #[must_use]
    pub(crate) fn fix(mut self, title: impl Into<String>, edits: Vec<(Place, String)>) -> Self {
        let title = title.into();
        self.finding.help.get_or_insert_with(|| title.clone());
        self.fix = Some(Fix { title, edits });
        self
    }

    /// Replaces the source of each place.
    pub(crate) fn map_sources(&mut self, source: impl Fn(SourceId) -> SourceId) {
        let labels = self.finding.related.iter_mut().map(|(place, _)| place);
        let edits = self.fix.iter_mut().flat_map(|fix| &mut fix.edits).map(|(place, _)| place);
        let places = std::iter::once(&mut self.finding.place).chain(labels).chain(edits);
        places.for_each(|place| place.source = source(place.source));
    }
}

/// Collects the findings of lints.
#[derive(Debug, Default)]
pub(crate) struct Findings(pub(crate) Vec<Linted>);

impl Findings {
    pub(crate) fn report(&mut self, finding: Linted) {
        self.0.push(finding);
    }
}

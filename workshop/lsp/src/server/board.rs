//! What is known to be wrong with each document, from where, and what of it the client has been told.

use crate::documents::Replaced;
use crate::job::About;
use diagnostics::{Finding, SourceId};
use lsp_types::Diagnostic;
use rustc_hash::FxHashMap;

/// Findings and what became of them.
#[derive(Debug, Default)]
pub(crate) struct Board {
    /// Counts the changes of any text.
    pub(crate) revision: u64,
    /// The document that the client has opened or changed last.
    pub(crate) latest: Option<SourceId>,
    /// The revision that was last handed to be checked.
    pub(crate) checked: u64,
    /// The revision that was last handed to the slow lints.
    pub(crate) linted: u64,
    /// What the slow lints said last. It stays, moved along with the text, until they say something
    /// else: a warning that comes and goes with every letter would be worse than one that is late.
    pub(crate) lints: FxHashMap<SourceId, Warnings>,
    /// What planner and validator said last, by the document that the command was about.
    pub(crate) verdicts: FxHashMap<SourceId, Verdict>,
    /// What the client was told.
    pub(crate) told: FxHashMap<SourceId, Told>,
}

/// What the slow lints said of a document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Warnings {
    pub(crate) said: Vec<Finding>,
}

impl Warnings {
    /// Moves them along with a change of the text; what the change touches is not said any more.
    pub(crate) fn shift(&mut self, source: SourceId, change: &Replaced) {
        self.said.retain_mut(|finding| {
            let places = finding.related.iter_mut().map(|(place, _)| place);
            let moved =
                places.filter(|place| place.source == source).all(|place| change.shift(&mut place.span));
            let main = &mut finding.place;
            moved && (main.source != source || change.shift(&mut main.span))
        });
    }
}

/// What planner or validator said.
#[derive(Clone, Debug)]
pub(crate) struct Verdict {
    /// By document.
    pub(crate) diagnostics: Vec<(SourceId, Diagnostic)>,
    /// The texts that it is about.
    pub(crate) about: About,
}

/// What the client was told of a document.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Told {
    pub(crate) version: Option<i32>,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

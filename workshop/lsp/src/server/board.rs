//! The findings in each document by source, and those that were published.

use crate::documents::Replaced;
use crate::job::About;
use diagnostics::{Finding, SourceId};
use lsp_types::Diagnostic;
use rustc_hash::FxHashMap;

/// The findings of a session.
#[derive(Debug, Default)]
pub(crate) struct Board {
    /// Counts the changes of any text.
    pub(crate) revision: u64,
    /// The document that the client has opened or changed last.
    pub(crate) latest: Option<SourceId>,
    /// The revision of the last check that was started.
    pub(crate) checked: u64,
    /// The revision of the last run of the slow lints that was started.
    pub(crate) linted: u64,
    /// The last findings of the slow lints. They stay, moved along with the text, until the next run: a
    /// warning that flickers with every letter would be worse than a late one.
    pub(crate) lints: FxHashMap<SourceId, Warnings>,
    /// The last remarks of planner and validator, by the command's document.
    pub(crate) verdicts: FxHashMap<SourceId, Verdict>,
    /// The published findings.
    pub(crate) told: FxHashMap<SourceId, Told>,
}

/// The slow lints' findings in a document.
#[derive(Clone, Debug, Default)]
pub(crate) struct Warnings {
    pub(crate) said: Vec<Finding>,
}

impl Warnings {
    /// Moves them along with a change of the text; drops those that the change touches.
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

/// The remarks of planner or validator.
#[derive(Clone, Debug)]
pub(crate) struct Verdict {
    /// By document.
    pub(crate) diagnostics: Vec<(SourceId, Diagnostic)>,
    /// The texts that it is about.
    pub(crate) about: About,
}

/// The published findings in a document.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Told {
    pub(crate) version: Option<i32>,
    pub(crate) diagnostics: Vec<Diagnostic>,
}

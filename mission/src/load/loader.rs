//! Reading files through [`Files`], and collecting findings.

use pddl::Source;

use crate::files::Files;
use diagnostics::{Finding, Place, SourceId, Sources};

/// The state of a loader: the texts and the findings so far.
pub(crate) struct Loader<'f> {
    pub(crate) files: &'f dyn Files,
    pub(crate) sources: Sources,
    pub(crate) findings: Vec<Finding>,
}

impl Loader<'_> {
    /// Reads a file. A failure is reported at the place that names the file.
    pub(crate) fn source(&mut self, path: &str, asked_at: Place) -> Option<SourceId> {
        match self.files.read(path) {
            Ok(text) if text.len() <= Source::MAX_BYTES => Some(self.sources.push(Source::new(path, text))),
            Ok(_) => self.unreadable(path, asked_at, "it is longer than 4 GiB"),
            Err(error) => self.unreadable(path, asked_at, &error.to_string()),
        }
    }

    fn unreadable<T>(&mut self, path: &str, asked_at: Place, reason: &str) -> Option<T> {
        self.findings.push(Finding::error("E0707", asked_at, format!("cannot read `{path}`: {reason}")));
        None
    }

    /// The names in a folder that end in `extension`, sorted.
    pub(crate) fn names(&mut self, folder: &str, extension: &str, asked_at: Place) -> Vec<String> {
        match self.files.list(folder) {
            Ok(mut names) => {
                names.retain(|n| n.ends_with(extension));
                names.sort();
                names
            }
            Err(error) => self.unreadable(folder, asked_at, &error.to_string()).unwrap_or_default(),
        }
    }
}

//! The lints' findings in a file, and all findings in it.
//!
//! Lints run only on models that are sound, together with the models that they depend on: in a draft, half
//! of all names are unused. A finding in a domain counts only if all its problems agree, so a domain is
//! linted with them. Bound: if its problems exceed [`MOST_LINTED`] bytes in sum, the domain is linted alone,
//! and a larger problem is not linted at all.

use crate::{FileKind, Linted, Project};
use diagnostics::{Finding, SourceId};

/// Longest problems that are linted, in bytes.
const MOST_LINTED: usize = 2 << 20;

impl Project {
    /// The lints' findings in a file, in order of place; empty while it or its domain has errors.
    pub fn lint_findings(&self, id: SourceId) -> &[Linted] {
        self.lint_cache(id).map_or(&[], |cache| cache.get_or_init(|| lints(self, id)))
    }

    /// All findings in a file, in order of place.
    pub fn findings(&self, id: SourceId) -> Vec<Finding> {
        let lints = self.lint_findings(id).iter().map(|linted| &linted.finding);
        let mut all: Vec<Finding> = self.language_findings(id).iter().chain(lints).cloned().collect();
        all.sort_by_key(|finding| finding.place.span);
        all
    }
}

/// The lints' findings, in order of place.
fn lints(project: &Project, id: SourceId) -> Vec<Linted> {
    let size = |id: SourceId| project.source(id).text().len();
    let mut said = match project.kind(id) {
        FileKind::Plan => Vec::new(),
        FileKind::Problem if size(id) > MOST_LINTED => Vec::new(),
        FileKind::Problem => project.lint_problem(id, project.lint_level()),
        FileKind::Domain if project.dependents(id).map(size).sum::<usize>() > MOST_LINTED => {
            project.lint_domain(id, project.lint_level())
        }
        FileKind::Domain => project.lint_family(id, project.lint_level()),
    };
    said.retain(|linted| linted.finding.place.source == id);
    said
}

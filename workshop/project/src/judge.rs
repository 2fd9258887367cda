//! What there is to say about a file: the language's word first, then that of the lints.
//!
//! Lints look only at models that are sound, alone and with what they depend on: in a draft half of everything
//! is unused. What they find in a domain counts only if all its problems agree, so a domain is linted with
//! them. Bound: with problems of more than [`MOST_LINTED`] bytes in sum the domain is looked at alone, and a
//! larger problem not at all.

use pddl::Severity;

use crate::{FileKind, Linted, Project, Reading};
use diagnostics::{Finding, Place, SourceId};

/// Longest problems that are linted, in bytes.
const MOST_LINTED: usize = 2 << 20;

/// What the language says, in order of place.
pub(crate) fn language(project: &Project, id: SourceId, reading: &Reading) -> Vec<Finding> {
    let diagnostics = reading.diagnostics().iter();
    if project.kind(id) != FileKind::Problem || has_its_domain(project, id, reading) {
        return diagnostics.map(|d| d.finding(id)).collect();
    }
    // Without its domain every name in it is unknown: what is said is what is missing, and what the text alone
    // shows.
    let mut findings: Vec<Finding> =
        diagnostics.filter(|d| &d.code()[1..] < "0200").map(|d| d.finding(id)).collect();
    if let Some(need) = project.header(id).and_then(|header| header.needs.first()) {
        let place = Place { source: id, span: need.span };
        let mut finding =
            Finding::error("E0212", place, format!("no file defines the domain `{}`", need.name));
        let domains = project.ids().filter(|&other| project.kind(other) == FileKind::Domain);
        let names: Vec<&str> =
            domains.filter_map(|other| Some(project.header(other)?.name.as_str())).collect();
        if let Some(near) = diagnostics::nearest(&need.name, names) {
            finding = finding.help(format!("did you mean `{near}`?"));
        }
        findings.push(finding);
    }
    findings.sort_by_key(|finding| finding.place.span);
    findings
}

/// Whether a problem was read with the domain that it means. One of another name that stands beside it counts, as
/// long as the problem has no errors with it.
fn has_its_domain(project: &Project, id: SourceId, reading: &Reading) -> bool {
    let wanted = project.header(id).and_then(|header| header.needs.first());
    let found = project.domain_of(id).and_then(|domain| project.header(domain));
    let Some(found) = found else { return false };
    wanted.is_none_or(|wanted| wanted.name == found.name)
        || reading.diagnostics().iter().all(|d| d.severity != Severity::Error)
}

/// What the lints say, in order of place.
pub(crate) fn lints(project: &Project, id: SourceId) -> Vec<Linted> {
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

//! All findings in a file: the parser's first, then the lints'.
//!
//! Lints run only on models that are sound, together with the models that they depend on: in a draft, half
//! of all names are unused. A finding in a domain counts only if all its problems agree, so a domain is
//! linted with them. Bound: if its problems exceed [`MOST_LINTED`] bytes in sum, the domain is linted alone,
//! and a larger problem is not linted at all.

use pddl::Severity;

use crate::{FileKind, Linted, Project, Reading};
use diagnostics::{Finding, Place, SourceId};

/// Longest problems that are linted, in bytes.
const MOST_LINTED: usize = 2 << 20;

/// The parser's findings, in order of place.
pub(crate) fn language(project: &Project, id: SourceId, reading: &Reading) -> Vec<Finding> {
    let diagnostics = reading.diagnostics().iter();
    if project.kind(id) != FileKind::Problem || has_its_domain(project, id, reading) {
        return diagnostics.map(|d| d.finding(id)).collect();
    }
    // Without its domain every name in a problem is unknown, so only the missing domain and the errors of
    // the text itself are reported.
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

/// Whether a problem was read with the domain that it requires. A domain of another name beside it counts,
/// as long as the problem has no errors with it.
fn has_its_domain(project: &Project, id: SourceId, reading: &Reading) -> bool {
    let wanted = project.header(id).and_then(|header| header.needs.first());
    let found = project.domain_of(id).and_then(|domain| project.header(domain));
    let Some(found) = found else { return false };
    wanted.is_none_or(|wanted| wanted.name == found.name)
        || reading.diagnostics().iter().all(|d| d.severity != Severity::Error)
}

/// The lints' findings, in order of place.
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

//! The parser's findings in a file.

use pddl::Severity;

use crate::{Header, Reading};
use diagnostics::{Finding, Place, SourceId};

/// The findings in a file, in order of place.
pub(crate) fn of(id: SourceId, reading: &Reading) -> Vec<Finding> {
    reading.diagnostics().iter().map(|d| d.finding(id)).collect()
}

/// The findings in a problem, in order of place. `domain` is the header of the domain that it was read with, `known` are
/// the names of all domains.
pub(crate) fn of_problem<'a>(
    id: SourceId,
    reading: &Reading,
    header: &Header,
    domain: Option<&Header>,
    known: impl Iterator<Item = &'a str>,
) -> Vec<Finding> {
    if has_its_domain(reading, header, domain) {
        return of(id, reading);
    }
    // Without its domain every name in a problem is unknown, so only the missing domain and the errors of the text itself
    // are reported.
    let own = reading.diagnostics().iter().filter(|d| &d.code()[1..] < "0200");
    let mut findings: Vec<Finding> = own.map(|d| d.finding(id)).collect();
    if let Some(need) = header.needs.first() {
        let place = Place { source: id, span: need.span };
        let mut finding =
            Finding::error("E0212", place, format!("no file defines the domain `{}`", need.name));
        if let Some(near) = diagnostics::nearest(&need.name, known) {
            finding = finding.help(format!("did you mean `{near}`?"));
        }
        findings.push(finding);
    }
    findings.sort_by_key(|finding| finding.place.span);
    findings
}

/// Whether a problem was read with the domain that it requires. A domain of another name beside it counts, as long as the
/// problem has no errors with it.
fn has_its_domain(reading: &Reading, header: &Header, domain: Option<&Header>) -> bool {
    let Some(domain) = domain else { return false };
    header.needs.first().is_none_or(|wanted| wanted.name == domain.name)
        || reading.diagnostics().iter().all(|d| d.severity != Severity::Error)
}

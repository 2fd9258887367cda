//! The case of a domain or problem: its diagnostics and lints compared with what is expected.

use crate::expected::{CodeAt, Warnings, Written};
use crate::suite::Suite;
use diagnostics::{Finding, SourceId};
use pddl::{Severity, Span};

impl Suite {
    /// The errors, and the warnings where they are denied.
    pub(crate) fn clean(&self, file: SourceId, warnings: Warnings) -> Vec<Finding> {
        if warnings == Warnings::Deny {
            let counts = |finding: &Finding| finding.severity != Severity::Unsupported;
            return self.project.findings(file).into_iter().filter(counts).collect();
        }
        self.project.language_findings(file).iter().filter(|finding| finding.is_error()).cloned().collect()
    }

    /// These and no others. Each expectation takes the first finding that it matches; those with a line come first, so
    /// that a code alone takes one of the remaining findings.
    pub(crate) fn diagnostics(
        &self,
        file: SourceId,
        entry: Span,
        expected: &[Written<CodeAt>],
    ) -> Vec<Finding> {
        let mut left: Vec<Finding> = self.project.findings(file);
        let line = |finding: &Finding| self.source(file).line_column(finding.place.span.start).line;
        let mut failed = Vec::new();
        let (exact, loose): (Vec<_>, Vec<_>) = expected.iter().partition(|e| e.value.line.is_some());
        for Written { value, span } in exact.into_iter().chain(loose) {
            let fits = |finding: &Finding| {
                finding.code == Some(&*value.code) && value.line.is_none_or(|wanted| line(finding) == wanted)
            };
            match left.iter().position(fits) {
                Some(position) => drop(left.remove(position)),
                None => {
                    let name = self.source(file).name();
                    let at = value.line.map(|line| format!(" at line {line}")).unwrap_or_default();
                    let message = format!("{} is expected{at} of {name}, and is not there", value.code);
                    let elsewhere = left.iter().find(|finding| finding.code == Some(&*value.code));
                    let mut finding = Finding::error("T0301", self.written(*span), message);
                    if let Some(found) = elsewhere {
                        finding = finding.related(found.place, format!("{} is here", value.code));
                    }
                    failed.push(finding);
                }
            }
        }
        for mut finding in left {
            finding.related.push((self.written(entry), "this does not expect it".to_owned()));
            failed.push(finding);
        }
        failed
    }
}

//! Which lints run over what, and what is left of their findings.
//!
//! Problem: many mistakes in a domain show only with its problems (nothing ever makes this predicate true), but one
//! problem proves little: an action that is of no use there may be all that another one needs. Idea: problems are
//! handed in one after the other; a finding *in the domain* that comes of looking at problems counts only if all of
//! them gave it. Invariant: findings are in order of place, and none is on a line that allows it.

use pddl::model::{Domain, Problem};
use pddl::{FileKind, Source};

use crate::finding::Findings;
use crate::lint::Check;
use crate::view::{DomainView, ProblemView};
use crate::{Finding, Level, all};

/// A text and what it means.
#[derive(Debug)]
pub struct File<'a, M> {
    /// The text.
    pub source: &'a Source,
    /// What it means.
    pub model: &'a M,
}

impl<M> Clone for File<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for File<'_, M> {}

/// Looks at a domain and its problems.
pub struct Linter<'a> {
    domain: DomainView<'a>,
    level: Level,
    /// What all problems so far say about the domain; `None` before the first.
    agreed: Option<Vec<Finding>>,
}

impl<'a> Linter<'a> {
    /// For a domain; lints above `level` do not run.
    pub fn new(domain: File<'a, Domain>, level: Level) -> Self {
        Self { domain: DomainView::new(domain), level, agreed: None }
    }

    /// What is found in a problem. What it says about the domain is kept for [`Linter::finish`].
    pub fn problem(&mut self, problem: File<'_, Problem>) -> Vec<Finding> {
        let view = ProblemView::new(&self.domain, problem);
        let mut found = Findings::default();
        for lint in all().filter(|l| l.level <= self.level) {
            for check in lint.checks {
                if let Check::Problem(check) = check {
                    check(&view, &mut found);
                }
            }
        }
        let (about_domain, mut here): (Vec<_>, Vec<_>) =
            found.0.into_iter().partition(|f| f.place.file == FileKind::Domain);
        here.retain(|f| !view.allows.silence(f.lint, view.source, f.place.span));
        match &mut self.agreed {
            None => self.agreed = Some(about_domain),
            Some(agreed) => agreed.retain(|a| about_domain.iter().any(|f| same(a, f))),
        }
        in_order(here)
    }

    /// What is found in the domain.
    pub fn finish(self) -> Vec<Finding> {
        let mut found = Findings(self.agreed.unwrap_or_default());
        // Places in one of several problems mean nothing to whoever reads the domain.
        for finding in &mut found.0 {
            finding.labels.retain(|(place, _)| place.file == FileKind::Domain);
        }
        for lint in all().filter(|l| l.level <= self.level) {
            for check in lint.checks {
                if let Check::Domain(check) = check {
                    check(&self.domain, &mut found);
                }
            }
        }
        let Findings(mut found) = found;
        found.retain(|f| !self.domain.allows.silence(f.lint, self.domain.source, f.place.span));
        in_order(found)
    }
}

fn same(a: &Finding, b: &Finding) -> bool {
    a.place == b.place && a.lint.code() == b.lint.code() && a.message == b.message
}

fn in_order(mut findings: Vec<Finding>) -> Vec<Finding> {
    findings.sort_by_key(|f| (f.place.span.start, f.place.span.end, f.lint.code()));
    findings.dedup_by(|a, b| same(a, b));
    findings
}

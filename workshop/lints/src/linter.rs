//! Runs lints over a domain and its problems.
//!
//! Problem: many mistakes in a domain show only with its problems (nothing ever makes this predicate true), but one
//! problem proves little: it may not need an action that another problem depends on. Idea: the caller passes the problems
//! one after the other. A finding *in the domain* that depends on problems counts only if every problem gives it.
//! Invariant: findings are in order of place, and no finding is on a line whose comment allows it.

use diagnostics::{Source, SourceId};
use pddl::model::{Domain, Problem};

use crate::finding::{Findings, Linted};
use crate::lint::{Check, Level, Lint};
use crate::place::{DOMAIN, PROBLEM};
use crate::registry::{all, find};
use crate::view::{DomainView, ProblemView};

/// A text with its model.
#[derive(Debug)]
pub struct File<'a, M> {
    /// The id that findings name the text by.
    pub id: SourceId,
    /// The text.
    pub source: &'a Source,
    /// Its model.
    pub model: &'a M,
}

impl<M> Clone for File<'_, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<M> Copy for File<'_, M> {}

/// Lints a domain and its problems.
pub struct Linter<'a> {
    domain: DomainView<'a>,
    id: SourceId,
    level: Level,
    /// The findings in the domain that all problems so far gave; `None` before the first problem.
    agreed: Option<Vec<Linted>>,
}

impl<'a> Linter<'a> {
    /// For a domain; lints above `level` do not run.
    pub fn new(domain: File<'a, Domain>, level: Level) -> Self {
        Self {
            domain: DomainView::new(domain.source, domain.model, code_of),
            id: domain.id,
            level,
            agreed: None,
        }
    }

    /// The findings in a problem. Those in the domain are kept for [`Linter::finish`].
    pub fn problem(&mut self, problem: File<'_, Problem>) -> Vec<Linted> {
        if problem.model.objects.iter().any(|object| object.types.are_several()) {
            self.domain.types_are_combined.set(true);
        }
        let view = ProblemView::new(&self.domain, problem.source, problem.model, code_of);
        let mut found = Findings::default();
        for lint in all().filter(|l| l.level <= self.level) {
            for check in lint.checks {
                if let Check::Problem(check) = check {
                    check(&view, &mut found);
                }
            }
        }
        let (in_domain, mut here): (Vec<_>, Vec<_>) =
            found.0.into_iter().partition(|f| f.finding.place.source == DOMAIN);
        here.retain(|f| !view.allows.silence(f.code(), view.source, f.finding.place.span));
        match &mut self.agreed {
            None => self.agreed = Some(in_domain),
            Some(agreed) => agreed.retain(|a| in_domain.iter().any(|f| same(a, f))),
        }
        self.in_order(here, problem.id)
    }

    /// The findings in the domain.
    pub fn finish(mut self) -> Vec<Linted> {
        let mut found = Findings(self.agreed.take().unwrap_or_default());
        // A place in one of several problems means nothing to a reader of the domain.
        for linted in &mut found.0 {
            linted.finding.related.retain(|(place, _)| place.source == DOMAIN);
        }
        for lint in all().filter(|l| l.level <= self.level) {
            for check in lint.checks {
                if let Check::Domain(check) = check {
                    check(&self.domain, &mut found);
                }
            }
        }
        let Findings(mut found) = found;
        let allows = &self.domain.allows;
        found.retain(|f| !allows.silence(f.code(), self.domain.source, f.finding.place.span));
        self.in_order(found, self.id)
    }

    /// Findings in order, each once, with the ids of the files.
    fn in_order(&self, mut findings: Vec<Linted>, problem: SourceId) -> Vec<Linted> {
        findings.sort_by_key(|Linted { finding: f, .. }| (f.place.span.start, f.place.span.end, f.code));
        findings.dedup_by(|a, b| same(a, b));
        let id = |source| if source == PROBLEM { problem } else { self.id };
        findings.iter_mut().for_each(|linted| linted.map_sources(id));
        findings
    }
}

/// The code of the lint with that name or code.
fn code_of(word: &str) -> Option<&'static str> {
    find(word).map(Lint::code)
}

fn same(Linted { finding: a, .. }: &Linted, Linted { finding: b, .. }: &Linted) -> bool {
    a.place == b.place && a.code == b.code && a.message == b.message
}

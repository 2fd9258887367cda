//! Decides which document is checked when, and when its findings are published.
//!
//! Problem: one letter typed into a domain may change the findings in a thousand problems, and the author
//! waits for those of one file. Idea: after a change, when the queue is empty, a job reads a snapshot: first
//! the open documents, the last changed one before all others, then their dependents. The job shares its
//! readings with the server's project, so publishing them costs nothing. A change stops the job after the
//! current file. Slow lints wait for a quiet period. Invariant: published findings belong to the present
//! texts.

use super::Server;
use super::board::{Told, Warnings};
use crate::answers::diagnostics;
use crate::job::{Purpose, Running};
use crate::news::JobNews;
use crate::options::DiagnosticsMode;
use crate::outbox::Asked;
use ::diagnostics::SourceId;
use budget::Cancellation;
use lsp_types::{
    Diagnostic, DiagnosticRefreshRequest, PublishDiagnosticsNotification, PublishDiagnosticsParams,
};
use project::{Linted, Project};
use std::collections::BTreeSet;

/// Most closed documents that are checked because of open ones.
const CLOSED: usize = 500;

impl Server {
    /// Handles a change of any text.
    pub(crate) fn changed(&mut self) {
        self.board.revision += 1;
        for job in self.jobs.iter() {
            if matches!(job.purpose, Purpose::Check(_) | Purpose::Lint(_)) {
                job.cancel.cancel();
            }
        }
    }

    /// Starts a check if a text has changed and no check is running.
    pub(crate) fn check(&mut self) {
        let revision = self.board.revision;
        if self.board.checked == revision || self.jobs.any(|p| matches!(p, Purpose::Check(_))) {
            return;
        }
        self.board.checked = revision;
        let order = self.audience();
        self.forget_all_but(&order);
        let project = self.documents.project().clone();
        self.jobs.start(background(Purpose::Check(revision)), move |reporter| {
            for source in order {
                if reporter.is_cancelled() {
                    return;
                }
                project.language_findings(source);
                reporter.say(JobNews::Checked(source));
            }
        });
    }

    /// Handles a document that a job has read.
    pub(crate) fn checked(&mut self, purpose: &Purpose, source: SourceId) {
        if *purpose == Purpose::Check(self.board.revision) {
            self.publish(source);
        }
    }

    /// Whether the slow lints should run in the next quiet period.
    pub(crate) fn wants_lints(&self) -> bool {
        self.options.lints
            && self.board.linted != self.board.revision
            && !self.jobs.any(|p| matches!(p, Purpose::Lint(_) | Purpose::Scan))
    }

    /// Starts the slow lints.
    pub(crate) fn lint(&mut self) {
        if !self.wants_lints() {
            return;
        }
        let revision = self.board.revision;
        self.board.linted = revision;
        let audience = self.audience();
        let project = self.documents.project().clone();
        self.jobs.start(background(Purpose::Lint(revision)), move |reporter| {
            for source in audience {
                if reporter.is_cancelled() {
                    return;
                }
                reporter.say(JobNews::Linted(source, project.lint_findings(source).to_vec()));
            }
        });
    }

    /// Handles a job's lint findings.
    pub(crate) fn linted(&mut self, purpose: &Purpose, source: SourceId, said: Vec<Linted>) {
        if *purpose == Purpose::Lint(self.board.revision) {
            let said = said.into_iter().map(|linted| linted.finding).collect();
            self.board.lints.insert(source, Warnings { said });
            self.publish(source);
        }
    }

    /// All findings in a document, from every source.
    pub(crate) fn diagnostics(&self, source: SourceId) -> Vec<Diagnostic> {
        let findings = self.documents.project().language_findings(source);
        let warnings = self.board.lints.get(&source).filter(|_| self.options.lints);
        let warnings = warnings.into_iter().flat_map(|warnings| &warnings.said);
        let all = findings.iter().chain(warnings);
        let mut said: Vec<Diagnostic> =
            all.map(|finding| diagnostics::of_finding(&self.documents, &self.client, finding)).collect();
        for verdict in self.board.verdicts.values() {
            if verdict.about.stamps.iter().all(|&(id, stamp)| self.documents.stamp(id) == stamp) {
                let here = verdict.diagnostics.iter().filter(|(at, _)| *at == source);
                said.extend(here.map(|(_, diagnostic)| diagnostic.clone()));
            }
        }
        said
    }

    /// Publishes the findings in a document if they have changed.
    pub(crate) fn publish(&mut self, source: SourceId) {
        if self.options.diagnostics == DiagnosticsMode::Pull {
            if self.client.refreshes.diagnostics && self.documents.open(source).is_some() {
                self.outbox.ask::<DiagnosticRefreshRequest>((), Asked::Courtesy);
            }
            return;
        }
        let version = self.documents.open(source).map(|open| open.version);
        let told = Told { version, diagnostics: self.diagnostics(source) };
        let before = self.board.told.get(&source);
        if before == Some(&told) || before.is_none() && told == Told::default() {
            return;
        }
        self.send(source, told);
    }

    fn send(&mut self, source: SourceId, told: Told) {
        let uri = self.documents.uri(source);
        let (version, diagnostics) = (told.version, told.diagnostics.clone());
        self.outbox.notify::<PublishDiagnosticsNotification>(PublishDiagnosticsParams {
            uri,
            version,
            diagnostics,
        });
        self.board.told.insert(source, told);
    }

    /// Clears the findings in documents that are not checked any more.
    fn forget_all_but(&mut self, looked_at: &[SourceId]) {
        let mut gone: Vec<SourceId> =
            self.board.told.keys().copied().filter(|source| !looked_at.contains(source)).collect();
        gone.sort_unstable();
        for source in gone {
            self.withdraw(source);
        }
    }

    /// Clears the findings in a document if any were published.
    pub(crate) fn withdraw(&mut self, source: SourceId) {
        let told = self.board.told.get(&source);
        if told.is_some_and(|told| !told.diagnostics.is_empty()) {
            self.send(source, Told::default());
        }
        self.board.told.remove(&source);
        self.board.lints.remove(&source);
    }

    /// The documents whose findings are published, in order of importance.
    fn audience(&self) -> Vec<SourceId> {
        let mut open = self.documents.all_open();
        open.sort_by_key(|&id| (Some(id) != self.board.latest, id));
        let closed = related(self.documents.project(), &open);
        open.extend(closed.into_iter().take(CLOSED));
        open
    }
}

fn background(purpose: Purpose) -> Running {
    Running { purpose, cancel: Cancellation::default(), answers: None, token: None }
}

/// The files that open documents need, and their dependents. Problems that only share a domain with an open
/// one are not related.
fn related(project: &Project, open: &[SourceId]) -> Vec<SourceId> {
    let mut found: BTreeSet<SourceId> = BTreeSet::new();
    let mut above = open.to_vec();
    while let Some(id) = above.pop() {
        above.extend(project.needs(id).iter().flatten().filter(|&&need| found.insert(need)));
    }
    let mut below: BTreeSet<SourceId> = open.iter().copied().collect();
    loop {
        let needs_one = |id: &SourceId| project.needs(*id).iter().flatten().any(|need| below.contains(need));
        let more: Vec<SourceId> = project.ids().filter(|id| !below.contains(id) && needs_one(id)).collect();
        if more.is_empty() {
            break;
        }
        below.extend(more);
    }
    found.extend(below);
    found.into_iter().filter(|id| !open.contains(id)).collect()
}

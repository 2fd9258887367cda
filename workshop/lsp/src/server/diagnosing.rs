//! When which document is checked, and when the client hears of it.
//!
//! Problem: a letter typed into a domain may change what is wrong with a thousand problems, and the author waits for
//! the answer about one file. Idea: after a change, once nothing else waits, a job reads a snapshot: open documents first,
//! the one changed last before all, then those that depend on them. Its readings are shared with ours, so what it has
//! read costs nothing when it is published. A change stops the job after the file that it is at. Slow lints wait until
//! nothing has happened for a while. Invariant: what is published belongs to the texts as they are now.

use super::Server;
use super::board::{Told, Warnings};
use crate::answers::diagnostics;
use crate::host::Cancel;
use crate::job::{Purpose, Running};
use crate::news::JobNews;
use crate::options::DiagnosticsMode;
use crate::outbox::Asked;
use ::diagnostics::SourceId;
use lsp_types::{
    Diagnostic, DiagnosticRefreshRequest, PublishDiagnosticsNotification, PublishDiagnosticsParams,
};
use project::{Linted, Project};
use std::collections::BTreeSet;

/// How many closed documents are checked because of open ones.
const CLOSED: usize = 500;

impl Server {
    /// Some text has changed.
    pub(crate) fn changed(&mut self) {
        self.board.revision += 1;
        for job in self.jobs.iter() {
            if matches!(job.purpose, Purpose::Check(_) | Purpose::Lint(_)) {
                job.cancel.cancel();
            }
        }
    }

    /// Starts to check, if there is anything new and nobody is at it.
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

    /// A job has read a document.
    pub(crate) fn checked(&mut self, purpose: &Purpose, source: SourceId) {
        if *purpose == Purpose::Check(self.board.revision) {
            self.publish(source);
        }
    }

    /// Whether slow lints are due when nothing happens.
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

    /// A job has looked for modelling mistakes.
    pub(crate) fn linted(&mut self, purpose: &Purpose, source: SourceId, said: Vec<Linted>) {
        if *purpose == Purpose::Lint(self.board.revision) {
            let said = said.into_iter().map(|linted| linted.finding).collect();
            self.board.lints.insert(source, Warnings { said });
            self.publish(source);
        }
    }

    /// Everything that is known about a document.
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

    /// Tells the client what is wrong with a document, if that is news.
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

    /// Of documents that are not looked at any more, nothing is said.
    fn forget_all_but(&mut self, looked_at: &[SourceId]) {
        let mut gone: Vec<SourceId> =
            self.board.told.keys().copied().filter(|source| !looked_at.contains(source)).collect();
        gone.sort_unstable();
        for source in gone {
            self.withdraw(source);
        }
    }

    /// Says that nothing is wrong with a document, if anything was.
    pub(crate) fn withdraw(&mut self, source: SourceId) {
        let told = self.board.told.get(&source);
        if told.is_some_and(|told| !told.diagnostics.is_empty()) {
            self.send(source, Told::default());
        }
        self.board.told.remove(&source);
        self.board.lints.remove(&source);
    }

    /// The documents that the client hears of, in the order in which it should.
    fn audience(&self) -> Vec<SourceId> {
        let mut open = self.documents.all_open();
        open.sort_by_key(|&id| (Some(id) != self.board.latest, id));
        let closed = related(self.documents.project(), &open);
        open.extend(closed.into_iter().take(CLOSED));
        open
    }
}

fn background(purpose: Purpose) -> Running {
    Running { purpose, cancel: Cancel::default(), answers: None, token: None }
}

/// What open documents need, and what needs them. Problems that only share a domain with an open one are not related.
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

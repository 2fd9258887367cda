//! The findings of the files of a project, shown and counted.

use super::tally::Tally;
use crate::console::Console;
use crate::render::{show, show_all};
use diagnostics::{Finding, Place, SourceId};
use pddl::SequentialPlan;
use project::{FileKind, Project};
use std::collections::BTreeSet;
use validator::{Validator, Verdict, explain};

/// A file of the project.
#[derive(Clone, Copy)]
pub(super) struct File {
    pub(super) id: SourceId,
    /// Whether the user named it.
    pub(super) given: bool,
}

/// The given files and those that they need, directly or not.
pub(super) fn wanted(project: &Project, files: &[File]) -> BTreeSet<SourceId> {
    let mut way: Vec<SourceId> = files.iter().filter(|file| file.given).map(|file| file.id).collect();
    let mut wanted = BTreeSet::new();
    while let Some(id) = way.pop() {
        if wanted.insert(id) {
            way.extend(project.needs(id).iter().flatten());
        }
    }
    wanted
}

/// Shows the findings of files. Files that others need come first: domains, then problems, then plans.
pub(super) struct Checked<'a> {
    project: &'a Project,
    files: &'a [File],
    tallies: Vec<Tally>,
    /// Domains that have been reported as ill-formed.
    ill_formed: BTreeSet<SourceId>,
}

impl<'a> Checked<'a> {
    pub(super) fn new(project: &'a Project, files: &'a [File]) -> Self {
        let tallies = vec![Tally { checked: true, ..Tally::default() }; files.len()];
        Self { project, files, tallies, ill_formed: BTreeSet::new() }
    }

    /// Shows the findings; returns a tally for each file, in the order of the files.
    pub(super) fn run(mut self, console: &mut Console<'_>) -> Vec<Tally> {
        for kind in [FileKind::Domain, FileKind::Problem, FileKind::Plan] {
            for index in 0..self.files.len() {
                if self.project.kind(self.files[index].id) == kind {
                    self.file(index, console);
                }
            }
        }
        self.tallies
    }

    fn file(&mut self, index: usize, console: &mut Console<'_>) {
        let File { id, given } = self.files[index];
        let findings = self.project.findings(id);
        self.tallies[index] = Tally::of(findings.iter().map(|finding| finding.severity));
        // A file that was not given is shown only if its errors prevent the check of a given file.
        if given || self.tallies[index].errors > 0 {
            show_all(self.project.sources(), &findings, console);
        }
        self.meaning(id, console);
    }

    /// Reports a domain that is read without errors but ill-formed: its axioms depend on each other in a circle.
    fn meaning(&mut self, id: SourceId, console: &mut Console<'_>) {
        if self.project.kind(id) == FileKind::Problem
            && let Ok(task) = self.project.task(id)
            && let Err(refusal) = Validator::new(task.domain, task.problem)
            && matches!(*refusal, Verdict::IllFormed(_))
            && let Some(why) = explain(task.domain, task.problem, &SequentialPlan::default(), &refusal)
            && let Some(index) = self.files.iter().position(|file| file.id == task.domain_file)
            && self.ill_formed.insert(task.domain_file)
        {
            self.tallies[index].errors += 1;
            let place = Place { source: task.domain_file, span: why.place.span };
            show(self.project.sources(), &Finding::answer(place, why.sentence), console);
        }
    }
}

//! A case, held against what is so.

use crate::suite::{Case, CaseId, Suite, What};
use diagnostics::{Finding, Place, Sources};
use pddl::Span;
use pddl::model::{Domain, Problem};
use std::time::Duration;

/// What a case may use up.
#[derive(Clone, Copy)]
pub struct Limits<'a> {
    /// The time since some moment.
    pub now: &'a (dyn Fn() -> Duration + Sync),
    /// The most bytes for one question to the planner.
    pub memory_bytes: Option<usize>,
}

impl Default for Limits<'_> {
    /// A clock that stands still, and all the memory there is.
    fn default() -> Self {
        Self { now: &|| Duration::ZERO, memory_bytes: None }
    }
}

impl std::fmt::Debug for Limits<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Limits").field("memory_bytes", &self.memory_bytes).finish_non_exhaustive()
    }
}

/// A domain with a problem, both without errors.
pub(crate) struct Task<'a> {
    pub(crate) domain: &'a Domain,
    pub(crate) problem: &'a Problem,
    pub(crate) files: TaskFiles,
}

/// The files of a task.
#[derive(Clone, Copy)]
pub(crate) struct TaskFiles {
    pub(crate) domain: diagnostics::SourceId,
    pub(crate) problem: diagnostics::SourceId,
}

impl Suite {
    /// Runs a case. What differs from what is expected is answered; nothing is a case that passed.
    pub fn run(&self, id: CaseId, limits: &Limits<'_>) -> Vec<Finding> {
        let Some(Case { file, what, .. }) = self.case(id) else { return Vec::new() };
        match what {
            What::Clean(warnings) => self.clean(*file, *warnings),
            What::Diagnostics { entry, expected } => self.diagnostics(*file, *entry, expected),
            What::Solvable { expected, timeout } => match self.task(*file) {
                Ok(task) => self.solvable(&task, *expected, *timeout, limits),
                Err(finding) => vec![*finding],
            },
            What::Plan(case) => match self.task(case.problem) {
                Ok(task) => self.plan(&task, *file, case),
                Err(finding) => vec![*finding],
            },
        }
    }

    /// The problem in that file with its domain.
    ///
    /// # Errors
    /// What keeps it from being one.
    pub(crate) fn task(&self, problem: diagnostics::SourceId) -> Result<Task<'_>, Box<Finding>> {
        let without = |place: Place, message: String| Err(Box::new(Finding::error("T0311", place, message)));
        let project = &self.project;
        let Some(domain_file) = project.domain_of(problem) else {
            return without(Sources::start_of(problem), "this problem has no domain".to_owned());
        };
        for file in [domain_file, problem] {
            if !project.reading(file).is_some_and(project::Reading::is_sound) {
                let first = project.language_findings(file).iter().find(|finding| finding.is_error());
                let why = first.map_or_else(String::new, |finding| format!(": {}", finding.message));
                let place = first.map_or(Sources::start_of(file), |finding| finding.place);
                return without(place, format!("this file has errors{why}"));
            }
        }
        let (Some(domain), Some(model)) = (project.domain(domain_file), project.problem(problem)) else {
            return without(Sources::start_of(problem), "this is no problem of a domain".to_owned());
        };
        let files = TaskFiles { domain: domain_file, problem };
        Ok(Task { domain, problem: model, files })
    }

    /// A place in `expected.toml`.
    pub(crate) fn written(&self, span: Span) -> Place {
        Place { source: self.expected, span }
    }
}

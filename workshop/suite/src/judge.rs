//! A case, held against what is so.

use crate::suite::{Case, CaseId, Suite, What};
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::Span;
use project::{NoTask, Task};
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
    pub(crate) fn task(&self, problem: SourceId) -> Result<Task<'_>, Box<Finding>> {
        self.project.task(problem).map_err(|lack| {
            let start = Sources::start_of(problem);
            let (place, message) = match lack {
                NoTask::NoDomain => (start, "this problem has no domain".to_owned()),
                NoTask::NoProblem => (start, "this is no problem of a domain".to_owned()),
                NoTask::Errors(file, None) => (Sources::start_of(file), "this file has errors".to_owned()),
                NoTask::Errors(_, Some(first)) => {
                    (first.place, format!("this file has errors: {}", first.message))
                }
            };
            Box::new(Finding::error("T0311", place, message))
        })
    }

    /// A place in `expected.toml`.
    pub(crate) fn written(&self, span: Span) -> Place {
        Place { source: self.expected, span }
    }
}

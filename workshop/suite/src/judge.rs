//! Runs a case: parser, planner or validator, compared with what is expected.

use crate::solve::{Clock, Means};
use crate::suite::{Case, CaseId, Suite, What};
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::Span;
use planner::Budget;
use project::{NoTask, Task};

impl Suite {
    /// Runs a case and returns how it differs from what is expected; a case that passed has no findings. `budget` is for
    /// each question to the planner.
    pub fn run(&self, id: CaseId, clock: &Clock<'_>, budget: &Budget<'_>) -> Vec<Finding> {
        let Some(Case { file, what, .. }) = self.case(id) else { return Vec::new() };
        match what {
            What::Clean(warnings) => self.clean(*file, *warnings),
            What::Diagnostics { entry, expected } => self.diagnostics(*file, *entry, expected),
            What::Solvable { expected, timeout } => match self.task(*file) {
                Ok(task) => self.solvable(&task, *expected, *timeout, &Means { clock, budget }),
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
    /// A finding about what the task lacks.
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

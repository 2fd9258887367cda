//! The plan that `pelea plan --repair` repairs, read from its file.

use crate::console::Console;
use crate::exit::Exit;
use crate::render::{show, show_all};
use crate::task::{TaskFiles, read_source};
use diagnostics::{Finding, Place, SourceId, Sources};
use pddl::model::{ActionId, ObjectId};
use pddl::{Plan, PlanStep, Severity, parse_plan};
use planner::{OperatorId, Task};
use std::collections::HashMap;
use std::path::Path;

/// Up to this many omitted steps are reported at their places; the others are listed in one line.
const WARNINGS: usize = 3;

/// A plan that no longer fits its problem, with its file.
pub(super) struct OldPlan {
    sources: Sources,
    file: SourceId,
    steps: Vec<PlanStep>,
}

impl OldPlan {
    /// Reads the old plan and reports its errors.
    ///
    /// # Errors
    /// The exit code if the file cannot be read, or its plan is not sequential.
    pub(super) fn read(path: &Path, files: &TaskFiles, console: &mut Console<'_>) -> Result<Self, Exit> {
        let (sources, file) = Sources::of(read_source(path, console)?);
        let parsed = parse_plan(&sources[file], &files.domain, &files.problem);
        let findings: Vec<_> = parsed.diagnostics.iter().map(|d| d.finding(file)).collect();
        let worst = show_all(&sources, &findings, console);
        let kind = match parsed.model {
            Some(Plan::Sequential(plan)) => return Ok(Self { sources, file, steps: plan.steps }),
            Some(Plan::Temporal(_)) => "a plan with times",
            Some(Plan::Hierarchical(_)) => "a plan with its decomposition",
            None if worst == Some(Severity::Unsupported) => return Err(Exit::Unsupported),
            None => return Err(Exit::Unreadable),
        };
        let refusal = Finding::answer(Sources::start_of(file), format!("{kind} cannot be repaired"));
        show(&sources, &Finding { severity: Severity::Unsupported, ..refusal }, console);
        Err(Exit::Unsupported)
    }

    /// The name of its file.
    pub(super) fn name(&self) -> &str {
        self.sources[self.file].name()
    }

    /// The number of its steps.
    pub(super) fn length(&self) -> usize {
        self.steps.len()
    }

    /// Its steps as operators, and the texts of the steps without an operator. The latter are
    /// reported.
    pub(super) fn operators(&self, task: &Task, console: &mut Console<'_>) -> (Vec<OperatorId>, Vec<String>) {
        let mut known: HashMap<(ActionId, &[ObjectId]), Option<OperatorId>> =
            self.steps.iter().map(|step| ((step.action, step.arguments.as_slice()), None)).collect();
        for (id, operator) in task.operators().enumerate() {
            if let Some(place) = known.get_mut(&(operator.action, operator.arguments)) {
                place.get_or_insert(id);
            }
        }
        let (mut operators, mut left_out) = (Vec::new(), Vec::new());
        for step in &self.steps {
            if let Some(&Some(operator)) = known.get(&(step.action, step.arguments.as_slice())) {
                operators.push(operator);
                continue;
            }
            let text = self.sources[self.file].slice(step.span);
            left_out.push(text.to_owned());
            if left_out.len() > WARNINGS {
                continue;
            }
            let place = Place { source: self.file, span: step.span };
            let message = format!(
                "{text} can never be done in this problem, or does nothing for its goal; it is left out"
            );
            let severity = Severity::Warning;
            show(&self.sources, &Finding { severity, ..Finding::answer(place, message) }, console);
        }
        if left_out.len() > WARNINGS {
            console.note(&format!("left out as well: {}", left_out[WARNINGS..].join(" ")));
        }
        (operators, left_out)
    }
}

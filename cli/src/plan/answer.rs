//! The answers of `pelea plan`: each outcome shown, recorded, and turned into an exit code.

use super::record::{CostKind, PlanRecord, UnsolvableRecord};
use super::unsolvable::Unsolvable;
use super::written::validated;
use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::render::{self, show};
use crate::task::TaskFiles;
use diagnostics::{Finding, Place};
use pddl::Severity;
use planner::{GroundError, Origin, Task};
use std::fmt::Write;
use std::path::Path;

/// A limit ended the search.
pub(super) fn no_answer(limit: &str, answer: &mut PlanRecord, console: &mut Console<'_>) -> Exit {
    answer.end("limit", limit);
    console.record(answer);
    console.note(&format!("no plan found: {limit}"));
    Exit::Limit
}

/// Grounding failed: it reached a limit, or the task uses a feature that is not supported.
pub(super) fn not_grounded(
    error: &GroundError,
    files: &TaskFiles,
    answer: &mut PlanRecord,
    console: &mut Console<'_>,
) -> Exit {
    match error {
        GroundError::Unsupported { origin, span, .. } => {
            let source = match origin {
                Origin::Domain => files.domain_file,
                Origin::Problem => files.problem_file,
            };
            unsupported(Place { source, span: *span }, error.to_string(), files, answer, console)
        }
        GroundError::Limit { .. } | GroundError::Interrupted { .. } => {
            no_answer(&error.to_string(), answer, console)
        }
    }
}

/// The task uses a feature that is not supported.
pub(super) fn unsupported(
    place: Place,
    text: String,
    files: &TaskFiles,
    answer: &mut PlanRecord,
    console: &mut Console<'_>,
) -> Exit {
    answer.end("unsupported", &text);
    let severity = Severity::Unsupported;
    show(&files.sources, &Finding { severity, ..Finding::answer(place, text) }, console);
    console.record(answer);
    Exit::Unsupported
}

/// A plan is found: it is validated, written to `output` or printed, and reported.
pub(super) fn solved(
    output: Option<&Path>,
    files: &TaskFiles,
    task: &Task,
    found: &planner::Plan,
    answer: &mut PlanRecord,
    console: &mut Console<'_>,
) -> Exit {
    let (mut text, valid) = match validated(files, task, found, console) {
        Ok(validated) => validated,
        Err(exit) => return exit,
    };
    answer.steps = text.lines().map(str::to_owned).collect();
    let kind = CostKind::of(&files.problem);
    writeln!(text, "; cost = {} ({})", valid.cost(), kind.text()).expect("a string takes all");
    match output {
        Some(path) => {
            if let Err(error) = files::write(path, &text) {
                render::error(error.to_string(), console);
                return Exit::Unwritable;
            }
            console.note(&format!(
                "{}, cost {}, written to {}",
                render::counted(valid.steps as usize, "step", "steps"),
                valid.cost(),
                path.display()
            ));
        }
        None => console.result(text.trim_end()),
    }
    if let Some(optimal) = answer.optimal {
        console.note(if optimal { "no plan is better" } else { "there may be better plans" });
    }
    answer.solved(&valid, kind);
    console.record(answer);
    Exit::Yes
}

/// No plan exists: the reasons are shown.
pub(super) fn unsolvable(
    why: &Unsolvable<'_>,
    files: &TaskFiles,
    answer: &mut PlanRecord,
    console: &mut Console<'_>,
) -> Exit {
    let sentence = why.words().sentence();
    let place = Place { source: files.problem_file, span: files.problem.goal_span };
    show(&files.sources, &Finding::answer(place, format!("there is no plan: {sentence}")), console);
    why.words().lines().iter().for_each(|line| console.note(line));
    answer.unsolvable = Some(UnsolvableRecord::of(why, files));
    answer.end("unsolvable", &sentence);
    console.record(answer);
    Exit::No
}

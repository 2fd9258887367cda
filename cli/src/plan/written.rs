//! Plans of the planner as texts that the validator checks.

use crate::console::Console;
use crate::exit::Exit;
use crate::render::{self, show};
use crate::task::TaskFiles;
use crate::validate::answer;
use pddl::{PlanStep, Source, Span};
use planner::Task;
use validator::{Valid, Verdict, explain, validate};

/// A plan as the text of a plan file, one step per line, and as the parser reads that text.
pub(crate) fn written(task: &Task, found: &planner::Plan) -> (String, pddl::SequentialPlan) {
    let mut text = String::new();
    let mut plan = pddl::SequentialPlan::default();
    for &id in &found.operators {
        let line = task.operator_name(id);
        let start = u32::try_from(text.len()).unwrap_or(u32::MAX);
        let end = u32::try_from(text.len() + line.len()).unwrap_or(u32::MAX);
        let operator = task.operator(id);
        plan.steps.push(PlanStep {
            action: operator.action,
            arguments: operator.arguments.to_vec(),
            span: Span::new(start, end),
        });
        text.push_str(&line);
        text.push('\n');
    }
    (text, plan)
}

/// A plan of the planner as the text of a plan file, and the validator's verdict on it.
///
/// # Errors
/// [`Exit::Bug`] if the plan is invalid; the reason has been shown.
pub(super) fn validated(
    files: &TaskFiles,
    task: &Task,
    found: &planner::Plan,
    console: &mut Console<'_>,
) -> Result<(String, Valid), Exit> {
    let (text, plan) = written(task, found);
    match validate(&files.domain, &files.problem, &plan) {
        Verdict::Valid(valid) => Ok((text, valid)),
        verdict => Err(bug(&verdict, &plan, &text, files, console)),
    }
}

/// Reports a plan of the planner that is invalid. The whole plan is shown, since a bug report needs it.
fn bug(
    verdict: &Verdict,
    plan: &pddl::SequentialPlan,
    text: &str,
    files: &TaskFiles,
    console: &mut Console<'_>,
) -> Exit {
    let mut sources = files.sources.clone();
    let file = sources.push(Source::new("<plan>", text));
    if let Some(finding) = explain(&files.domain, &files.problem, plan, verdict) {
        show(&sources, &answer(&finding, verdict, files, file), console);
    }
    let text = "a bug in pelea: the planner's plan is not valid, so it was not written; please report it";
    render::error(text, console);
    Exit::Bug
}

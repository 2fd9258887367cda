//! `pelea plan --anytime`: improves the plan until the timeout or a proof of optimality.
//!
//! The search runs in its own thread and sends its plans. This thread validates each plan, writes it as `PLAN.1`,
//! `PLAN.2` … and reports it before it receives the next. The best plan is also written as `PLAN`, or printed if no
//! file was named. As JSON each plan is
//!
//! ```json
//! {"kind": "better_plan", "number": 2, "steps": 7, "cost": 12, "cost_kind": "general_cost",
//!  "after_ms": 812.5, "file": "PLAN.2"}
//! ```

use super::record::{BetterPlanRecord, CostKind};
use super::written::validated;
use crate::clock::Stopwatch;
use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::render;
use crate::task::TaskFiles;
use pddl::model::Objective;
use planner::{Budget, Improved, Query, SearchConfiguration, Task, improve};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use validator::Valid;

/// Validates, writes and reports the plans of a search.
struct Writer<'a> {
    files: &'a TaskFiles,
    task: &'a Task,
    output: Option<&'a Path>,
    watch: Stopwatch,
    count: usize,
    best: Option<Valid>,
}

/// Searches for better plans until one is proven optimal or `budget` is used up. Writes every
/// better plan when it is found.
///
/// # Errors
/// The exit code if a plan is invalid or cannot be written; the reason has been shown.
pub(super) fn run(
    files: &TaskFiles,
    task: &Task,
    configuration: &SearchConfiguration,
    budget: &Budget<'_>,
    output: Option<&Path>,
    console: &mut Console<'_>,
) -> Result<Improved, Exit> {
    let stop = AtomicBool::new(false);
    let interrupted = || stop.load(Ordering::Relaxed) || (budget.interrupted)();
    let budget = Budget { interrupted: &interrupted, ..*budget };
    let (sender, plans) = mpsc::channel();
    let mut writer = Writer { files, task, output, watch: Stopwatch::start(), count: 0, best: None };
    std::thread::scope(|scope| {
        let search = scope.spawn(|| {
            let sender = sender;
            // The receiver is gone after a failure, and then the search is cancelled.
            improve(task, &Query::of(task), configuration, &budget, &mut |plan| {
                drop(sender.send(plan.clone()));
            })
        });
        let mut failure = None;
        for plan in plans {
            if let Err(exit) = writer.take(&plan, console) {
                stop.store(true, Ordering::Relaxed);
                failure = Some(exit);
                break;
            }
        }
        let improved = search.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        failure.map_or(Ok(improved), Err)
    })
}

impl Writer<'_> {
    /// Validates a plan; if it is better than the best so far, writes and reports it.
    fn take(&mut self, found: &planner::Plan, console: &mut Console<'_>) -> Result<(), Exit> {
        let (text, valid) = validated(self.files, self.task, found, console)?;
        if self.best.as_ref().is_some_and(|best| !is_better(&valid, best)) {
            return Ok(());
        }
        self.count += 1;
        let kind = CostKind::of(&self.files.problem);
        let file = self.output.map(|path| numbered(path, self.count));
        if let Some(file) = &file {
            files::write(file, &format!("{text}; cost = {} ({})\n", valid.cost(), kind.text())).map_err(
                |error| {
                    render::error(error.to_string(), console);
                    Exit::Unwritable
                },
            )?;
        }
        let after_ms = self.watch.milliseconds();
        let place = file.as_ref().map(|file| format!(", written to {}", file.display()));
        console.note(&format!(
            "plan {}: {}, cost {}, after {after_ms} ms{}",
            self.count,
            render::counted(valid.steps as usize, "step", "steps"),
            valid.cost(),
            place.unwrap_or_default()
        ));
        console.record(&BetterPlanRecord {
            kind: "better_plan",
            number: self.count,
            steps: valid.steps,
            cost: valid.cost(),
            cost_kind: kind,
            after_ms,
            file: file.map(|file| file.display().to_string()),
        });
        self.best = Some(valid);
        Ok(())
    }
}

/// `PLAN.2`.
fn numbered(path: &Path, number: usize) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(format!(".{number}"));
    PathBuf::from(name)
}

fn is_better(new: &Valid, old: &Valid) -> bool {
    match new.metric.map(|metric| metric.objective) {
        Some(Objective::Maximize) => new.cost() > old.cost(),
        Some(Objective::Minimize) | None => new.cost() < old.cost(),
    }
}

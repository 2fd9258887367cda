//! `pelea plan DOMAIN PROBLEM`: a plan on standard output or in a file, statistics on standard error.
//!
//! The validator checks every plan before it is written. An invalid plan is a bug of ours: it is not written, and the
//! exit code is 70. [`record`] documents the JSON.

mod answer;
mod anytime;
mod limit;
mod old_plan;
mod prefer;
mod record;
mod repair;
mod unsolvable;
mod written;

pub(crate) use limit::limit_words;
pub(crate) use unsolvable::Unsolvable;
pub(crate) use written::written;

use crate::clock::{Deadline, Seconds, Stopwatch};
use crate::console::Console;
use crate::exit::Exit;
use crate::memory;
use crate::task::TaskFiles;
use answer::{no_answer, not_grounded, solved, unsolvable, unsupported};
use clap::Args;
use diagnostics::Place;
use old_plan::OldPlan;
use planner::{Budget, GroundOptions, Outcome, Quality, Query, SearchConfiguration, ground, solve};
use prefer::Prefer;
use record::{PlanRecord, StatisticsRecord};
use std::fmt::Write;
use std::path::PathBuf;

/// The arguments of `pelea plan`.
#[derive(Debug, Args)]
#[command(after_help = format!("Searches:{}\n\nThe default search is {}, or {} with --optimal.",
    searches(), SearchConfiguration::portfolio().name, SearchConfiguration::best_optimal().name))]
pub(crate) struct Arguments {
    /// The domain file
    domain: PathBuf,
    /// The problem file
    problem: PathBuf,
    /// Write the plan to this file [default: standard output]
    #[arg(short, long, value_name = "PLAN")]
    output: Option<PathBuf>,
    /// Stop the search after this many seconds
    #[arg(long, value_name = "S")]
    timeout: Option<Seconds>,
    /// Limit the memory for the task and its states, in MiB [default: what the machine allows, 4096
    /// at most]
    #[arg(long, value_name = "MIB")]
    memory: Option<usize>,
    /// Use this search
    #[arg(long, value_name = "NAME", value_parser = search)]
    search: Option<SearchConfiguration>,
    /// Find an optimal plan
    #[arg(long, conflicts_with = "search")]
    optimal: bool,
    /// Improve the plan until the timeout or a proof of optimality; plans are written as PLAN.1,
    /// PLAN.2 …
    #[arg(long)]
    anytime: bool,
    /// Repair this plan, and compare the result with a new plan
    #[arg(long, value_name = "OLD_PLAN", conflicts_with = "anytime")]
    repair: Option<PathBuf>,
    /// Choose between the repaired and the new plan by this criterion [default: stability]
    #[arg(long, value_enum, requires = "repair")]
    prefer: Option<Prefer>,
}

fn search(name: &str) -> Result<SearchConfiguration, String> {
    SearchConfiguration::named(name)
        .ok_or_else(|| format!("there is no such search; there are{}", searches()))
}

/// One line per search.
fn searches() -> String {
    let mut text = String::new();
    for known in SearchConfiguration::ALL {
        write!(text, "\n  {:12} {}", known.name, known.summary).expect("a string takes all");
    }
    text
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let deadline = Deadline::after(arguments.timeout);
    let interrupted = move || deadline.is_over();
    let configuration = match arguments.search {
        Some(configuration) => configuration,
        None if arguments.optimal => SearchConfiguration::best_optimal(),
        None => SearchConfiguration::portfolio(),
    };
    let mut answer = PlanRecord::of(configuration.name);

    let watch = Stopwatch::start();
    let files = match TaskFiles::read(&arguments.domain, &[], &arguments.problem, console) {
        Ok(files) => files,
        Err(exit) => return exit,
    };
    let old = arguments.repair.as_ref().map(|path| OldPlan::read(path, &files, console)).transpose();
    let old = match old {
        Ok(old) => old,
        Err(exit) => return exit,
    };
    let read_ms = watch.milliseconds();

    let watch = Stopwatch::start();
    let memory = arguments.memory.map_or_else(memory::budget, |mebibytes| mebibytes.saturating_mul(1 << 20));
    let budget = Budget { memory_bytes: Some(memory), interrupted: &interrupted, ..Budget::default() };
    let options = GroundOptions { budget, ..GroundOptions::default() };
    let task = match ground(&files.domain, &files.problem, &options) {
        Ok(task) => task,
        Err(error) => return not_grounded(&error, &files, &mut answer, console),
    };
    let ground_ms = watch.milliseconds();

    let watch = Stopwatch::start();
    let budget = Budget { memory_bytes: Some(memory.saturating_sub(task.memory_bytes())), ..budget };
    let output = arguments.output.as_deref();
    let report = if let Some(old) = &old {
        let prefer = arguments.prefer.unwrap_or_default();
        match repair::run((&files, &task), old, prefer, &configuration, &budget, console) {
            Ok((record, report)) => {
                answer.repair = Some(record);
                report
            }
            Err(exit) => return exit,
        }
    } else if arguments.anytime {
        match anytime::run(&files, &task, &configuration, &budget, output, console) {
            Ok(improved) => {
                answer.optimal = Some(improved.quality == Quality::Optimal);
                improved.report
            }
            Err(exit) => return exit,
        }
    } else {
        solve(&task, &Query::of(&task), &configuration, &budget)
    };
    let statistics = StatisticsRecord::of(&task, &report, [read_ms, ground_ms, watch.milliseconds()]);
    console.note(&statistics.line(configuration.name));
    answer.statistics = Some(statistics);

    match &report.outcome {
        Outcome::Solved(plan) => solved(output, &files, &task, plan, &mut answer, console),
        Outcome::Unsolvable(reason) => {
            let why = Unsolvable::of(&files.domain, &files.problem, &task, reason, &budget);
            unsolvable(&why, &files, &mut answer, console)
        }
        Outcome::Unsupported(feature) => {
            let text = format!("this search does not support {feature}");
            let span = files.problem.metric.as_ref().map_or(files.problem.goal_span, |m| m.expression.span);
            unsupported(Place { source: files.problem_file, span }, text, &files, &mut answer, console)
        }
        Outcome::LimitReached(limit) => no_answer(limit_words(*limit), &mut answer, console),
    }
}

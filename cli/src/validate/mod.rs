//! `pelea validate DOMAIN PROBLEM PLAN...` or `pelea validate FOLDER...`: one verdict per line.
//!
//! The plans are collected first (`gather`). Then all cores judge them (`judge`), and the verdicts
//! are written in the order of the plans. If there are several tasks, a core takes a task with all
//! its plans, so memory holds at most one task per core; otherwise a core takes a plan. If there
//! are several verdicts, a last line counts them. Invariant: the exit code is 0 only if at least
//! one plan was given and every plan was read completely and is valid.
//!
//! The crate `validator` renders a verdict as text, JSON and HTML.

mod gather;
mod judge;
mod tally;

pub(crate) use judge::answer;

use crate::console::{Console, Said};
use crate::exit::Exit;
use crate::files;
use crate::pool;
use crate::render;
use crate::task::TaskFiles;
use clap::Args;
use gather::{Fault, Group, gather};
use judge::{Judge, Outcome, show_verdict};
use std::path::{Path, PathBuf};
use tally::Tally;
use validator::{Number, Precision, Validator, VerdictRecord, Word, html};

/// The arguments of `pelea validate`.
#[derive(Debug, Args)]
#[command(
    override_usage = "pelea validate [OPTIONS] DOMAIN PROBLEM PLAN...\n       pelea validate [OPTIONS] FOLDER..."
)]
pub(crate) struct Arguments {
    /// A domain, a problem and plans (`-` is standard input, a folder stands for the plan files in
    /// it); or folders that contain domains, problems and plans
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// Show the changes of each step
    #[arg(short = 'v', long, visible_alias = "verbose")]
    trace: bool,
    /// Suggest single changes that make an invalid plan valid; each was validated
    #[arg(long)]
    advice: bool,
    /// Write the given plan to this file, repaired by the first suggested change
    #[arg(long, value_name = "FILE")]
    fix: Option<PathBuf>,
    /// Write an HTML page with charts, states and explanations
    #[arg(long, value_name = "FILE")]
    html: Option<PathBuf>,
    /// Minimum distance of interfering happenings, in seconds; 0 checks only simultaneous ones
    #[arg(long, value_name = "SECONDS", default_value = "0.001", value_parser = seconds)]
    epsilon: Number,
    /// Tolerance for durations, in seconds, because planners round their output
    #[arg(long, value_name = "SECONDS", default_value = "0.01", value_parser = seconds)]
    tolerance: Number,
}

/// A duration in seconds, parsed exactly.
fn seconds(text: &str) -> Result<Number, &'static str> {
    let decimal: pddl::Decimal = text.parse().map_err(|_| "a number of seconds such as 0.001 is wanted")?;
    if decimal.is_negative() { Err("it must not be negative") } else { Ok(Number::from_decimal(decimal)) }
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    let gathered = gather(&arguments.paths);
    let mut tally = Tally::default();
    let mut exit = Exit::Yes;
    let mut sections = Vec::new();
    let mut fixed = None;
    let plans: usize = gathered.groups.iter().map(|group| group.plans.len()).sum();
    if arguments.fix.is_some() && plans > 1 {
        render::error("`--fix` takes one plan", console);
        return Exit::Unreadable;
    }
    for fault in &gathered.faults {
        exit = exit.and(refuse(fault, &mut tally, console));
    }
    if let [group] = gathered.groups.as_slice() {
        one_task(group, arguments, Cores::All, console, |outcome| {
            tally.count(outcome.word);
            sections.extend(outcome.section);
            fixed = outcome.fixed;
        });
    } else {
        let manner = console.manner();
        pool::in_order(
            &gathered.groups,
            |group| {
                let mut said = Said::default();
                let mut outcomes = Vec::new();
                let mut console = manner.console(&mut said);
                one_task(group, arguments, Cores::One, &mut console, |outcome| outcomes.push(outcome));
                drop(console);
                (outcomes, said)
            },
            |_, (outcomes, said)| {
                console.replay(&said);
                outcomes.into_iter().for_each(|outcome| {
                    tally.count(outcome.word);
                    sections.extend(outcome.section);
                });
            },
        );
    }
    if tally.plans() > 1 {
        console.result(&tally.line());
        console.record(&tally);
    }
    if let Some(path) = &arguments.html
        && let Err(error) = files::write(path, &html::page(&sections))
    {
        render::error(error.to_string(), console);
        exit = exit.and(Exit::Unwritable);
    }
    if let (Some(path), Some(plan)) = (&arguments.fix, &fixed)
        && let Err(error) = files::write(path, plan)
    {
        render::error(error.to_string(), console);
        exit = exit.and(Exit::Unwritable);
    }
    exit.and(tally.exit())
}

/// Reports an argument or file that cannot be judged.
fn refuse(fault: &Fault, tally: &mut Tally, console: &mut Console<'_>) -> Exit {
    render::error(fault.to_string(), console);
    if let Some(plan) = fault.plan() {
        unreadable(plan, fault.to_string(), console);
        tally.count(Word::Unreadable);
    }
    Exit::Unreadable
}

fn unreadable(plan: &Path, why: String, console: &mut Console<'_>) {
    let record = VerdictRecord::unread(&plan.display().to_string(), Word::Unreadable, Some(why));
    show_verdict(&record, console);
}

/// The threads that judge the plans of a task.
#[derive(Clone, Copy, Debug)]
enum Cores {
    One,
    All,
}

/// Reads a task and judges its plans; calls `done` for each of them in order.
fn one_task(
    group: &Group,
    arguments: &Arguments,
    cores: Cores,
    console: &mut Console<'_>,
    mut done: impl FnMut(Outcome),
) {
    let Ok(task) = TaskFiles::read(&group.domain, &group.imports, &group.problem, console) else {
        for plan in &group.plans {
            unreadable(plan, "its domain or problem cannot be read".to_owned(), console);
            done(Outcome { word: Word::Unreadable, section: None, fixed: None });
        }
        return;
    };
    let precision = Precision { tolerance: arguments.tolerance, separation: arguments.epsilon };
    let validator = Validator::new(&task.domain, &task.problem).map(|v| v.with_precision(precision));
    let judge = Judge {
        task: &task,
        validator: &validator,
        trace: arguments.trace,
        advice: arguments.advice || arguments.fix.is_some(),
        html: arguments.html.is_some(),
    };
    match cores {
        Cores::One => group.plans.iter().for_each(|plan| done(judge.plan(plan, console))),
        Cores::All => {
            let manner = console.manner();
            pool::in_order(
                &group.plans,
                |plan| {
                    let mut said = Said::default();
                    let mut console = manner.console(&mut said);
                    let outcome = judge.plan(plan, &mut console);
                    drop(console);
                    (outcome, said)
                },
                |_, (outcome, said)| {
                    console.replay(&said);
                    done(outcome);
                },
            );
        }
    }
}

//! `pelea test PATH...`: tests for domains as text.
//!
//! Every folder with an `expected.toml`, at a path or below it, is a suite (`suite`); docs/testing.md says what is in
//! it. Cases of all suites run side by side, and are shown one a line in the order of suites and cases whatever comes
//! first. What failed is explained at the end. As JSON a case is
//!
//! ```json
//! {"kind": "case", "suite": "domains/tea", "name": "domains/tea/plans/valid/a.plan::valid", "outcome": "pass",
//!  "time_ms": 0.4}
//! ```
//!
//! `outcome` is `pass` or `fail`; diagnostics that say why come before it. The last line is
//!
//! ```json
//! {"kind": "tests", "suites": 2, "unreadable": 0, "passed": 30, "failed": 1, "left_out": 0, "time_ms": 20.1}
//! ```

mod find;
mod init;
mod report;
mod watch;

use crate::clock::{Seconds, Stopwatch};
use crate::console::Console;
use crate::disk;
use crate::exit::Exit;
use crate::memory;
use crate::pool;
use crate::render;
use clap::Args;
use diagnostics::Finding;
use planner::Budget;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use suite::{CaseId, Suite};

/// What to test.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Folders; every folder with an `expected.toml` at or below them is a suite.
    #[arg(default_value = ".")]
    paths: Vec<PathBuf>,
    /// Only the cases whose names contain this; may be given several times.
    #[arg(long, value_name = "TEXT")]
    filter: Vec<String>,
    /// Stay, and run a suite again when one of its files changes.
    #[arg(long, conflicts_with = "init")]
    watch: bool,
    /// Write a first expected.toml into each folder given, from what is found now.
    #[arg(long)]
    init: bool,
    /// With --init: for how long to look for the cheapest plan of each problem.
    #[arg(long, value_name = "S", requires = "init", default_value = "10")]
    timeout: Seconds,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    if arguments.init {
        return init::run(&arguments.paths, arguments.timeout, console);
    }
    let exit = once(&arguments.paths, &arguments.filter, console);
    if !arguments.watch {
        return exit;
    }
    watch::watch(arguments, console, |_| ControlFlow::Continue(()))
}

/// Runs every suite at those paths.
fn once(paths: &[PathBuf], filter: &[String], console: &mut Console<'_>) -> Exit {
    let mut folders = Vec::new();
    for path in paths {
        if !path.is_dir() {
            let name = path.display();
            let why = if path.exists() { "it is no folder" } else { "there is no such folder" };
            render::error(format!("cannot test `{name}`: {why}"), console);
            return Exit::Unreadable;
        }
        find::folders(path, &mut folders);
    }
    folders.dedup();
    if folders.is_empty() {
        let help = "`pelea test --init FOLDER` writes a first one".to_owned();
        let text = "there is no suite here: no folder has an `expected.toml`";
        render::error_with_help(text, Some(help), console);
        return Exit::Unreadable;
    }
    run_folders(&folders, filter, console)
}

/// Runs the suites in those folders.
fn run_folders(folders: &[PathBuf], filter: &[String], console: &mut Console<'_>) -> Exit {
    let watch = Stopwatch::start();
    let (mut suites, mut exit, mut unreadable) = (Vec::new(), Exit::Yes, 0);
    for folder in folders {
        match find::read(folder) {
            Ok(found) => suites.push(Suite::read(found)),
            Err(error) => {
                render::error(error.to_string(), console);
                exit = Exit::Unreadable;
                unreadable += 1;
            }
        }
    }
    for suite in &suites {
        let shown = disk::show(suite.sources(), suite.findings(), console);
        unreadable += usize::from(shown != Exit::Yes);
        exit = exit.and(shown);
    }
    let mut report = report::Report::new(suites.len(), unreadable);
    let mut work: Vec<(&Suite, CaseId)> = Vec::new();
    for suite in &suites {
        for (id, case) in suite.cases() {
            if filter.is_empty() || filter.iter().any(|text| case.name.contains(text)) {
                work.push((suite, id));
            } else {
                report.left_out += 1;
            }
        }
    }
    let start = Instant::now();
    let now = move || start.elapsed();
    let budget = Budget { memory_bytes: Some(memory::budget() / pool::width()), ..Budget::default() };
    pool::in_order(
        &work,
        |&(suite, id)| {
            let watch = Stopwatch::start();
            let findings = suite.run(id, &now, &budget);
            (findings, watch.milliseconds())
        },
        |&(suite, id), (findings, time)| report.case(suite, id, findings, time, console),
    );
    exit = exit.and(report.finish(watch.milliseconds(), console));
    console.flush();
    exit
}

/// A case that failed.
struct Failed<'a> {
    suite: &'a Suite,
    name: &'a str,
    findings: Vec<Finding>,
}

/// How long the editor may take to write all that belongs to one change.
const SETTLED: Duration = Duration::from_millis(50);

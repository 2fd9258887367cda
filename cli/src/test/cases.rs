//! The cases of suites, run on all cores and reported in order.

use super::find;
use super::report::Report;
use crate::clock::Stopwatch;
use crate::console::Console;
use crate::disk;
use crate::exit::Exit;
use crate::memory;
use crate::pool;
use crate::render;
use planner::Budget;
use std::path::PathBuf;
use std::time::Instant;
use suite::{CaseId, Suite};

/// Runs the suites in those folders, and shows the outcome of each case.
pub(super) fn run_folders(folders: &[PathBuf], filter: &[String], console: &mut Console<'_>) -> Exit {
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
    let mut report = Report::new(suites.len(), unreadable);
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

//! The cases of suites and the scenarios of missions, run on all cores and reported in order.

use super::find;
use super::report::{Asked, Report};
use super::scenarios::{Rehearsal, Troupe};
use crate::clock::Stopwatch;
use crate::console::Console;
use crate::disk;
use crate::exit::Exit;
use crate::memory;
use crate::panics;
use crate::pool;
use crate::render;
use planner::Budget;
use std::path::PathBuf;
use std::time::Instant;
use suite::{CaseId, Suite};

/// One test.
enum Work<'a> {
    /// A case of a suite.
    Case { suite: &'a Suite, id: CaseId, name: &'a str },
    /// A scenario of a mission.
    Scenario(&'a Rehearsal<'a>),
}

impl<'a> Work<'a> {
    fn name(&self) -> &'a str {
        self.asked().name
    }

    fn asked(&self) -> Asked<'a> {
        match *self {
            Self::Case { suite, name, .. } => Asked { suite: suite.path(), name, sources: suite.sources() },
            Self::Scenario(of) => Asked { suite: of.mission(), name: &of.name, sources: &of.sources },
        }
    }
}

/// Runs the suites and the scenarios of missions in those folders, and shows the outcome of each case.
pub(super) fn run_folders(
    folders: &[PathBuf],
    missions: &[PathBuf],
    filter: &[String],
    console: &mut Console<'_>,
) -> Exit {
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
    let mut troupes = Vec::new();
    for folder in missions {
        match Troupe::read(folder, console) {
            Ok(troupe) => troupes.push(troupe),
            Err(shown) => {
                exit = exit.and(shown);
                unreadable += 1;
            }
        }
    }
    let mut rehearsals = Vec::new();
    for troupe in &troupes {
        match troupe.scenarios(console) {
            Ok(scenarios) => rehearsals.extend(scenarios),
            Err(shown) => {
                exit = exit.and(shown);
                unreadable += 1;
            }
        }
    }
    let mut report = Report::new(suites.len(), troupes.len(), unreadable);
    let of_suites = suites.iter().flat_map(|suite| suite.cases().map(move |(id, case)| (suite, id, case)));
    let mut work: Vec<Work<'_>> =
        of_suites.map(|(suite, id, case)| Work::Case { suite, id, name: &case.name }).collect();
    work.extend(rehearsals.iter().map(Work::Scenario));
    let all = work.len();
    work.retain(|work| filter.is_empty() || filter.iter().any(|text| work.name().contains(text)));
    report.left_out = all - work.len();
    let start = Instant::now();
    let now = move || start.elapsed();
    let budget = Budget { memory_bytes: Some(memory::budget() / pool::width()), ..Budget::default() };
    panics::without_those_of_runs(|| {
        pool::in_order(
            &work,
            |work| {
                let watch = Stopwatch::start();
                let findings = match work {
                    Work::Case { suite, id, .. } => suite.run(*id, &now, &budget),
                    Work::Scenario(scenario) => scenario.run(),
                };
                (findings, watch.milliseconds())
            },
            |work, (findings, time)| report.case(work.asked(), findings, time, console),
        );
    });
    exit = exit.and(report.finish(watch.milliseconds(), console));
    console.flush();
    exit
}

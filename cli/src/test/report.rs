//! The report of a test run: one line per case, the findings of failed cases, and the counts.

use crate::console::{Console, Form};
use crate::disk;
use crate::exit::Exit;
use diagnostics::{Finding, Sources};
use serde::Serialize;

/// The outcomes of the cases so far.
pub(super) struct Report<'a> {
    suites: usize,
    missions: usize,
    /// Suites and missions that could not be read.
    unreadable: usize,
    /// Cases that the filter excludes.
    pub(super) left_out: usize,
    passed: usize,
    failed: Vec<Failed<'a>>,
}

impl<'a> Report<'a> {
    /// The report before the first case.
    pub(super) fn new(suites: usize, missions: usize, unreadable: usize) -> Self {
        Self { suites, missions, unreadable, left_out: 0, passed: 0, failed: Vec::new() }
    }

    /// Reports a finished case.
    pub(super) fn case(
        &mut self,
        asked: Asked<'a>,
        findings: Vec<Finding>,
        time_ms: f64,
        console: &mut Console<'_>,
    ) {
        let Asked { suite, name, sources } = asked;
        let passed = findings.is_empty();
        let outcome = if passed { "pass" } else { "fail" };
        if console.form() == Form::Json {
            disk::show(sources, &findings, console);
        }
        let word = word(passed, console.result_colour());
        console.result(&format!("        {word} [{:>8.3}s] {}", time_ms / 1e3, name));
        console.record(&CaseRecord { kind: "case", suite, name, outcome, time_ms });
        console.flush();
        if passed {
            self.passed += 1;
        } else {
            self.failed.push(Failed { asked, findings });
        }
    }

    /// Reports the end: explains the failed cases, then the counts.
    pub(super) fn finish(self, time_ms: f64, console: &mut Console<'_>) -> Exit {
        if console.form() == Form::Text {
            for Failed { asked, findings } in &self.failed {
                console.note(&format!("\n──── {}", asked.name));
                disk::show(asked.sources, findings, console);
            }
        }
        let failed = self.failed.len();
        let cases = self.passed + failed;
        let mut line = format!(
            "────────────\n     Summary [{:>8.3}s] {cases} {} run: {} passed, {failed} failed",
            time_ms / 1e3,
            if cases == 1 { "case" } else { "cases" },
            self.passed
        );
        if self.left_out > 0 {
            line.push_str(&format!(", {} left out", self.left_out));
        }
        if self.unreadable > 0 {
            let suites = if self.unreadable == 1 { "suite or mission" } else { "suites or missions" };
            line.push_str(&format!("; {} {suites} could not be read", self.unreadable));
        }
        console.result(&line);
        for Failed { asked, .. } in &self.failed {
            console.result(&format!("        {} {}", word(false, console.result_colour()), asked.name));
        }
        console.record(&TestsRecord {
            kind: "tests",
            suites: self.suites,
            missions: self.missions,
            unreadable: self.unreadable,
            passed: self.passed,
            failed,
            left_out: self.left_out,
            time_ms,
        });
        if failed > 0 { Exit::No } else { Exit::Yes }
    }
}

/// What a case is about.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    /// The folder of the suite or the mission.
    pub(super) suite: &'a str,
    pub(super) name: &'a str,
    /// The sources of its findings.
    pub(super) sources: &'a Sources,
}

/// A case that failed.
struct Failed<'a> {
    asked: Asked<'a>,
    findings: Vec<Finding>,
}

fn word(passed: bool, colour: bool) -> &'static str {
    match (passed, colour) {
        (true, false) => "PASS",
        (false, false) => "FAIL",
        (true, true) => "\u{1b}[32;1mPASS\u{1b}[0m",
        (false, true) => "\u{1b}[31;1mFAIL\u{1b}[0m",
    }
}

#[derive(Serialize)]
struct CaseRecord<'a> {
    kind: &'static str,
    suite: &'a str,
    name: &'a str,
    outcome: &'static str,
    time_ms: f64,
}

#[derive(Serialize)]
struct TestsRecord {
    kind: &'static str,
    suites: usize,
    missions: usize,
    unreadable: usize,
    passed: usize,
    failed: usize,
    left_out: usize,
    time_ms: f64,
}

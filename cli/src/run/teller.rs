//! The report of a run on the console: the story during the run, then the summary.

use super::content::Content;
use super::judge::{Breakage, Record, Repairs};
use super::perform::Performed;
use super::story::Entry;
use super::terminal::Terminal;
use crate::clock::seconds;
use crate::console::{Console, Form};
use crate::exit::Exit;
use crate::files;
use crate::render;
use crate::scenario::Staged;
use dsr::Version;
use executive::Ending;
use mission::scenario::{Scenario, Violation};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// The last line of a run in JSON.
#[derive(Serialize)]
#[serde(tag = "kind", rename = "result")]
struct Summary<'a> {
    source: &'static str,
    time: f64,
    #[serde(flatten)]
    ending: &'a Ending,
    replans: u32,
    repairs: Repairs,
    asked_again: Vec<String>,
    violations: Vec<String>,
    broken: &'a [Breakage],
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    goals: BTreeMap<&'a str, &'a str>,
    report: &'a mission::report::Report,
}

/// What came of a run: its exit code, and what its scenario did not expect.
pub(crate) struct Verdict {
    pub(crate) exit: Exit,
    /// The name of the ending.
    pub(crate) ending: &'static str,
    pub(crate) violations: Vec<Violation>,
    pub(crate) broken: Vec<Breakage>,
}

/// Reports the story entry by entry, and summarises it.
pub(super) struct Teller<'m, 'c, 'o> {
    content: &'m Content,
    staged: Option<&'m Staged>,
    console: &'c mut Console<'o>,
    terminal: Terminal,
    record: Record<'m>,
    resumed: bool,
}

impl<'m, 'c, 'o> Teller<'m, 'c, 'o> {
    pub(super) fn new(
        content: &'m Content,
        staged: Option<&'m Staged>,
        verbose: bool,
        console: &'c mut Console<'o>,
    ) -> Self {
        let terminal = Terminal::new(console.result_colour(), console.result_width(), verbose);
        Self { content, staged, console, terminal, record: Record::new(&content.mission), resumed: false }
    }

    /// The mission and the scenario.
    pub(super) fn heading(&mut self) {
        let title = &self.content.mission.manifest.title;
        let scenario = self.staged.map_or("a person who answers", |s| &s.scenario.title);
        self.console.result(&format!("{title} · {scenario}"));
    }

    /// The run goes on after the end of its program.
    pub(super) fn goes_on(&mut self, elapsed: Duration, version: Version) {
        #[derive(Serialize)]
        #[serde(tag = "kind", rename = "resumed")]
        struct Resumed {
            time: f64,
            version: u64,
        }
        self.resumed = true;
        let time = seconds(elapsed);
        self.console
            .result(&format!("goes on at {time:.2} s, version {}: everybody begins again", version.0));
        self.console.record(&Resumed { time, version: version.0 });
    }

    /// One entry.
    pub(super) fn tell(&mut self, entry: &Entry) {
        self.record.note(entry);
        match self.console.form() {
            Form::Json => self.console.record(entry),
            Form::Text => {
                for line in self.terminal.lines(entry) {
                    self.console.result(&line);
                }
            }
        }
        self.console.flush();
    }

    /// The report, the expectations that were not met, and the exit code.
    pub(super) fn end(self, performed: &Performed, report_file: Option<&Path>) -> Verdict {
        let Performed { ending, snapshot, elapsed, begun } = performed;
        let report = self.content.report(snapshot);
        // A run that was cut short could not meet all that was expected of it; of one that went on, the story has only
        // the last part.
        let is_whole = *ending != Ending::Interrupted && !self.resumed;
        let judged = self.staged.filter(|_| is_whole);
        let unmet = judged
            .map_or_else(Vec::new, |staged| self.record.judge(staged, ending, self.content, snapshot, begun));
        let violations: Vec<String> = judged.map_or_else(Vec::new, |staged| {
            unmet.iter().map(|v| format!("{}: {v}", place(&staged.scenario, v.span()))).collect()
        });
        self.console.result("");
        let width = self.console.result_width().unwrap_or(usize::MAX);
        for line in report.to_string().lines() {
            // A rule that is wider than the terminal would wrap.
            let rule = line.starts_with('─');
            let line: String = line.chars().take(if rule { width } else { usize::MAX }).collect();
            self.console.result(&line);
        }
        let (replans, repairs) = (self.record.replans(), self.record.repairs());
        let time = seconds(*elapsed);
        let word = match ending {
            Ending::Accomplished => "accomplished",
            Ending::GivenUp { .. } => "ended without all its goals",
            Ending::WithHuman { .. } => "ended with a human",
            Ending::StillCalling { .. } => "ended still calling",
            Ending::StillGoing => "still going on",
            Ending::Interrupted => "interrupted",
        };
        self.console
            .result(&format!("\nmission {word} after {time:.1} s, {}", counted(replans, repairs.reuse)));
        if !self.record.goals().is_empty() {
            let goals =
                self.record.goals().iter().map(|(goal, life)| format!("{goal} {}", life.replace('_', " ")));
            self.console.result(&format!("goals: {}", goals.collect::<Vec<_>>().join(", ")));
        }
        let asked_again = self.record.asked_again().iter().map(ToString::to_string).collect();
        for violation in &violations {
            self.console.note(&format!("expectation not met: {violation}"));
        }
        let broken = self.record.broken();
        if !broken.is_empty() {
            let count = render::counted(broken.len(), "invariant", "invariants");
            self.console.note(&format!("{count} broken; the lines `broken` above say where"));
        }
        let failed = !violations.is_empty() || !broken.is_empty();
        let source = "result";
        self.console.record(&Summary {
            source,
            time,
            ending,
            replans,
            repairs,
            asked_again,
            violations,
            broken,
            goals: self.record.goals().iter().map(|(goal, life)| (&**goal, &**life)).collect(),
            report: &report,
        });
        let verdict =
            |exit| Verdict { exit, ending: ending.name(), violations: unmet, broken: broken.to_vec() };
        if let Some(path) = report_file {
            let json = serde_json::to_string_pretty(&report).unwrap_or_default();
            if let Err(error) = files::write(path, &format!("{json}\n")) {
                self.console.complain(&format!("error: {error}\n"));
                return verdict(Exit::Unwritable);
            }
        }
        verdict(match ending {
            Ending::Interrupted => Exit::Interrupted,
            Ending::Accomplished if !failed => Exit::Yes,
            _ => Exit::No,
        })
    }
}

fn counted(replans: u32, repaired: u32) -> String {
    match (replans, repaired) {
        (0, _) => "no replans".to_owned(),
        (1, 0) => "1 replan".to_owned(),
        (1, _) => "1 replan, a repair".to_owned(),
        (more, 0) => format!("{more} replans"),
        (more, some) => format!("{more} replans, {some} of them repairs"),
    }
}

/// `file:line:column` in a scenario.
fn place(scenario: &Scenario, span: pddl::Span) -> String {
    let at = scenario.source.line_column(span.start);
    format!("{}:{}:{}", scenario.source.name(), at.line, at.column)
}

//! `pelea check PATH...`: every error of every file and mission given, at its place.
//!
//! Folders stand for all `.pddl` and `.hddl` files below them, but a folder with a `mission.toml` is a mission
//! and checked as a whole (`mission`). The others are one project (`project`). Domains are found by name: among
//! the files given, then beside the file that needs them, then in the robots' folders (`robots/*/` of a folder
//! above); a plan's problem in its folder. As JSON there is, after its diagnostics, a line per file:
//!
//! ```json
//! {"kind": "checked", "file": "p.pddl", "errors": 0, "warnings": 1, "unsupported": 0,
//!  "checked": true}
//! ```

mod mission;
mod summary;

use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::nearby::{MANIFEST, beside, entries, is_source, provider};
use crate::render::{counted, show, show_all};
use crate::task::read_source;
use clap::Args;
use diagnostics::{Finding, Place, SourceId};
use lints::Level;
use pddl::{SequentialPlan, Severity, Source};
use project::{FileKind, Header, Need, Project};
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use validator::{Validator, Verdict, explain};

/// What to check.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Mission folders, other folders, and files.
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Say of each file only whether it can be read, then how many can: for collections of tasks.
    #[arg(long)]
    summary: bool,
    /// Show the warnings as well that are often meant as they are.
    #[arg(long)]
    pedantic: bool,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
    if arguments.summary {
        return summary::run(&arguments.paths, console);
    }
    let mut exit = Exit::Yes;
    let (mut paths, mut missions) = (Vec::new(), Vec::new());
    for path in &arguments.paths {
        if path.is_dir() {
            sources_below(path, &mut paths, &mut missions);
        } else if path.file_name().is_some_and(|name| name == MANIFEST) {
            missions.push(path.clone());
        } else {
            paths.push(path.clone());
        }
    }
    let level = if arguments.pedantic { Level::Pedantic } else { Level::Default };
    for mission in missions {
        exit = exit.and(mission::check(&mission, level, console));
    }
    let mut files: Vec<Candidate> = Vec::new();
    for path in paths {
        if files.iter().all(|file| file.path != path) {
            match read_source(&path, console) {
                Ok(source) => files.push(Candidate::new(path, source, true)),
                Err(unreadable) => exit = exit.and(unreadable),
            }
        }
    }
    find_needs(&mut files);
    let mut project = Project::without_names();
    project.set_lint_level(level);
    let given: Vec<bool> = files.iter().map(|file| file.given).collect();
    let ids = project.set_all(files.into_iter().map(|file| file.source));
    let files: Vec<File> = ids.into_iter().zip(given).map(|(id, given)| File { id, given }).collect();
    let wanted = wanted(&project, &files);
    let files: Vec<File> = files.into_iter().filter(|file| wanted.contains(&file.id)).collect();
    let tallies = Checked::new(&project, &files).run(console);
    for (file, tally) in files.iter().zip(&tallies).filter(|(file, _)| file.given) {
        exit = exit.and(if tally.errors == 0 { Exit::Yes } else { Exit::No });
        let path = project.path(file.id);
        console.result(&tally.line(path));
        console.record(&CheckedRecord { kind: "checked", file: path, tally: *tally });
    }
    exit
}

/// A file of the project.
#[derive(Clone, Copy)]
struct File {
    id: SourceId,
    /// Whether it is to be checked itself.
    given: bool,
}

/// The files that were given and those that they need.
fn wanted(project: &Project, files: &[File]) -> BTreeSet<SourceId> {
    let mut way: Vec<SourceId> = files.iter().filter(|file| file.given).map(|file| file.id).collect();
    let mut wanted = BTreeSet::new();
    while let Some(id) = way.pop() {
        if wanted.insert(id) {
            way.extend(project.needs(id).iter().flatten());
        }
    }
    wanted
}

/// A file that is checked, or that one of those needs.
struct Candidate {
    path: PathBuf,
    source: Source,
    header: Header,
    /// Whether it is to be checked itself.
    given: bool,
}

impl Candidate {
    fn new(path: PathBuf, source: Source, given: bool) -> Self {
        let header = Header::of(source.name(), source.text());
        Self { path, source, header, given }
    }

    fn defines(&self, domain: &str) -> bool {
        self.header.defines(domain)
    }
}

/// All sources in a folder and its folders, in order; folders that are missions apart.
fn sources_below(folder: &Path, found: &mut Vec<PathBuf>, missions: &mut Vec<PathBuf>) {
    if folder.join(MANIFEST).is_file() {
        missions.push(folder.to_owned());
        return;
    }
    let (folders, files): (Vec<_>, Vec<_>) = entries(folder).into_iter().partition(|path| path.is_dir());
    found.extend(files.into_iter().filter(|path| is_source(path)));
    for folder in folders.iter().filter(|folder| !folder.is_symlink()) {
        sources_below(folder, found, missions);
    }
}

/// Adds the files that define what others need and no file given defines.
fn find_needs(files: &mut Vec<Candidate>) {
    let mut sought = BTreeSet::new();
    let mut next = 0;
    while let Some(file) = files.get(next) {
        let (path, needs, kind) = (file.path.clone(), file.header.needs.clone(), file.header.kind);
        next += 1;
        // A plan says nowhere which problem it is for: its folder may.
        if kind == FileKind::Plan {
            for path in beside(&path) {
                if files.iter().all(|file| file.path != path)
                    && let Ok(source) = files::read(&path)
                {
                    files.push(Candidate::new(path, source, false));
                }
            }
        }
        for Need { name, .. } in needs {
            if files.iter().any(|f| f.defines(&name)) || !sought.insert((path.clone(), name.clone())) {
                continue;
            }
            if let Some((path, source)) = provider(&path, &name) {
                files.push(Candidate::new(path, source, false));
            }
        }
    }
}

/// What was found in a file.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Tally {
    errors: usize,
    warnings: usize,
    unsupported: usize,
    /// False where a file keeps the rest of a mission from being read.
    checked: bool,
}

impl Tally {
    fn of(severities: impl Iterator<Item = Severity>) -> Self {
        let mut tally = Self { checked: true, ..Self::default() };
        for severity in severities {
            match severity {
                Severity::Error => tally.errors += 1,
                Severity::Warning => tally.warnings += 1,
                Severity::Unsupported => tally.unsupported += 1,
            }
        }
        tally
    }

    fn line(&self, file: &str) -> String {
        format!("{file}: {}", self.verdict())
    }

    /// `2 errors, 1 warning`.
    fn verdict(&self) -> String {
        let parts = [
            (self.errors, "error", "errors"),
            (self.warnings, "warning", "warnings"),
            (self.unsupported, "unsupported feature", "unsupported features"),
        ];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(count, ..)| *count > 0)
            .map(|&(count, one, more)| counted(count, one, more))
            .collect();
        if parts.is_empty() { "no errors".to_owned() } else { parts.join(", ") }
    }
}

/// Everything that is wrong with the files, those first that others need.
struct Checked<'a> {
    project: &'a Project,
    files: &'a [File],
    tallies: Vec<Tally>,
    /// Domains whose lack of meaning has been shown.
    ill_formed: BTreeSet<SourceId>,
}

impl<'a> Checked<'a> {
    fn new(project: &'a Project, files: &'a [File]) -> Self {
        let tallies = vec![Tally { checked: true, ..Tally::default() }; files.len()];
        Self { project, files, tallies, ill_formed: BTreeSet::new() }
    }

    fn run(mut self, console: &mut Console<'_>) -> Vec<Tally> {
        for kind in [FileKind::Domain, FileKind::Problem, FileKind::Plan] {
            for index in 0..self.files.len() {
                if self.project.kind(self.files[index].id) == kind {
                    self.file(index, console);
                }
            }
        }
        self.tallies
    }

    fn file(&mut self, index: usize, console: &mut Console<'_>) {
        let File { id, given } = self.files[index];
        let findings = self.project.findings(id);
        self.tallies[index] = Tally::of(findings.iter().map(|finding| finding.severity));
        // A file that was not given speaks up if it keeps a given one from being checked.
        if given || self.tallies[index].errors > 0 {
            show_all(self.project.sources(), &findings, console);
        }
        self.meaning(id, console);
    }

    /// A problem that can be read may still have no meaning: its domain's axioms may go round.
    fn meaning(&mut self, id: SourceId, console: &mut Console<'_>) {
        if self.project.kind(id) == FileKind::Problem
            && let Ok(task) = self.project.task(id)
            && let Err(refusal) = Validator::new(task.domain, task.problem)
            && matches!(*refusal, Verdict::IllFormed(_))
            && let Some(why) = explain(task.domain, task.problem, &SequentialPlan::default(), &refusal)
            && let Some(index) = self.files.iter().position(|file| file.id == task.domain_file)
            && self.ill_formed.insert(task.domain_file)
        {
            self.tallies[index].errors += 1;
            let place = Place { source: task.domain_file, span: why.place.span };
            show(self.project.sources(), &Finding::answer(place, why.sentence), console);
        }
    }
}

#[derive(Serialize)]
struct CheckedRecord<'a> {
    kind: &'static str,
    file: &'a str,
    #[serde(flatten)]
    tally: Tally,
}

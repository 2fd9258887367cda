//! `pelea check PATH...`: every error of every file and mission given, at its place.
//!
//! Folders stand for all `.pddl` and `.hddl` files below them, but a folder with a `mission.toml` is a mission
//! and checked as a whole (`mission`). Domains are read before the problems and
//! domains that need them, found by name: among the files given, then beside the file that needs them,
//! then in the robots' folders (`robots/*/` of a folder above). As JSON there is, after its diagnostics, a
//! line per file:
//!
//! ```json
//! {"kind": "checked", "file": "p.pddl", "errors": 0, "warnings": 1, "unsupported": 0,
//!  "checked": true}
//! ```

mod mission;

use crate::console::Console;
use crate::exit::Exit;
use crate::header::{Header, Kind, Need};
use crate::render::{Message, show_all};
use crate::task::read_source;
use clap::Args;
use pddl::model::Domain;
use pddl::{Diagnostic, SequentialPlan, Severity, Source, parse_domain, parse_problem};
use serde::Serialize;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use validator::{Validator, Verdict, explain};

/// What makes a folder a mission.
const MANIFEST: &str = "mission.toml";

/// What to check.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Mission folders, other folders, and files.
    #[arg(required = true)]
    paths: Vec<PathBuf>,
}

pub(crate) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Exit {
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
    for mission in missions {
        exit = exit.and(mission::check(&mission, console));
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
    let tallies = Checked::new(&files).run(console);
    for (file, tally) in files.iter().zip(&tallies).filter(|(file, _)| file.given) {
        exit = exit.and(if tally.errors == 0 && tally.checked { Exit::Yes } else { Exit::No });
        console.result(&tally.line(file.source.name()));
        console.record(&CheckedRecord { kind: "checked", file: file.source.name(), tally: *tally });
    }
    exit
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
        let header = Header::of(source.text());
        Self { path, source, header, given }
    }

    fn defines(&self, domain: &str) -> bool {
        self.header.kind == Kind::Domain && self.header.name == domain
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

pub(crate) fn is_source(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("pddl") || e.eq_ignore_ascii_case("hddl"))
}

/// What is in a folder, in order; nothing if it cannot be read.
pub(crate) fn entries(folder: &Path) -> Vec<PathBuf> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path()).collect();
    paths.sort();
    paths
}

/// Adds the files that define what others need and no file given defines.
fn find_needs(files: &mut Vec<Candidate>) {
    let mut sought = BTreeSet::new();
    let mut next = 0;
    while let Some(file) = files.get(next) {
        let (path, needs) = (file.path.clone(), file.header.needs.clone());
        next += 1;
        for Need { name, .. } in needs {
            if files.iter().any(|f| f.defines(&name)) || !sought.insert((path.clone(), name.clone())) {
                continue;
            }
            if let Some(found) = nearby(&path).into_iter().find_map(|path| {
                let source = crate::files::read(&path).ok()?;
                let candidate = Candidate::new(path, source, false);
                candidate.defines(&name).then_some(candidate)
            }) {
                files.push(found);
            }
        }
    }
}

/// The sources beside a file, then those of the robots in the folders above it.
fn nearby(path: &Path) -> Vec<PathBuf> {
    let absolute = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut paths: Vec<PathBuf> = entries(folder).into_iter().filter(|p| is_source(p)).collect();
    for above in absolute.ancestors().skip(1) {
        for robot in entries(&above.join("robots")).iter().filter(|p| p.is_dir()) {
            paths.extend(entries(robot).into_iter().filter(|p| is_source(p)));
        }
    }
    paths
}

/// What was found in a file.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Tally {
    errors: usize,
    warnings: usize,
    unsupported: usize,
    /// False for a problem whose domain has errors.
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
        if !self.checked {
            return format!("{file}: not checked, since its domain has errors");
        }
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

/// `1 error`, `2 errors`.
fn counted(count: usize, one: &str, more: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { more })
}

/// The models read so far.
struct Checked<'a> {
    files: &'a [Candidate],
    domains: Vec<Option<Domain>>,
    tallies: Vec<Tally>,
    /// Domains whose lack of meaning has been shown.
    ill_formed: BTreeSet<usize>,
}

impl<'a> Checked<'a> {
    fn new(files: &'a [Candidate]) -> Self {
        Self {
            files,
            domains: files.iter().map(|_| None).collect(),
            tallies: vec![Tally::default(); files.len()],
            ill_formed: BTreeSet::new(),
        }
    }

    fn run(mut self, console: &mut Console<'_>) -> Vec<Tally> {
        for index in self.order() {
            self.domain(index, console);
        }
        for index in 0..self.files.len() {
            if self.files[index].header.kind == Kind::Problem {
                self.problem(index, console);
            }
        }
        self.tallies
    }

    /// The domains, each after those that it imports; those on a circle last.
    fn order(&self) -> Vec<usize> {
        let mut left: Vec<usize> =
            (0..self.files.len()).filter(|&i| self.files[i].header.kind == Kind::Domain).collect();
        let mut order = Vec::with_capacity(left.len());
        while !left.is_empty() {
            let waits = |index: usize, left: &[usize]| {
                self.files[index].header.needs.iter().any(|need| {
                    self.provider(index, &need.name).is_some_and(|p| p != index && left.contains(&p))
                })
            };
            let ready: Vec<usize> = left.iter().copied().filter(|&index| !waits(index, &left)).collect();
            let next = if ready.is_empty() { left.clone() } else { ready };
            left.retain(|index| !next.contains(index));
            order.extend(next);
        }
        order
    }

    /// The file that defines a domain for the file at `index`: one that shares its stem
    /// (`p01-domain.pddl` for `p01.pddl`), or else its folder, or else the first.
    fn provider(&self, index: usize, name: &str) -> Option<usize> {
        let path = &self.files[index].path;
        let stem = path.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_default();
        (0..self.files.len()).filter(|&i| self.files[i].defines(name)).min_by_key(|&i| {
            let other = &self.files[i].path;
            let near = other.parent() == path.parent();
            let alike = other.file_stem().is_some_and(|s| s.to_string_lossy().contains(&stem));
            (!near, !alike, i)
        })
    }

    fn show(&mut self, index: usize, diagnostics: &[Diagnostic], console: &mut Console<'_>) {
        self.tallies[index] = Tally::of(diagnostics.iter().map(|d| d.severity));
        // A file that was not given speaks up if it keeps a given one from being checked.
        if self.files[index].given || self.tallies[index].errors > 0 {
            show_all(&self.files[index].source, diagnostics, console);
        }
    }

    fn domain(&mut self, index: usize, console: &mut Console<'_>) {
        let file = &self.files[index];
        let imports: Vec<&Domain> = file
            .header
            .needs
            .iter()
            .filter_map(|need| self.domains[self.provider(index, &need.name)?].as_ref())
            .collect();
        let parsed = parse_domain(&file.source, &imports);
        self.show(index, &parsed.diagnostics, console);
        self.domains[index] = parsed.model;
    }

    fn problem(&mut self, index: usize, console: &mut Console<'_>) {
        let file = &self.files[index];
        let provider = file.header.needs.first().and_then(|need| self.provider(index, &need.name));
        let Some(provider) = provider else {
            self.tallies[index] = Tally { errors: 1, checked: true, ..Tally::default() };
            let (text, span) = match file.header.needs.first() {
                Some(need) => (format!("no file defines the domain `{}`", need.name), need.span),
                None => ("the problem does not name its domain".to_owned(), pddl::Span::default()),
            };
            Message::error(text).at(&file.source, span).show(console);
            return;
        };
        let Some(domain) = self.domains[provider].take() else {
            return;
        };
        let parsed = parse_problem(&file.source, &domain);
        self.show(index, &parsed.diagnostics, console);
        if let Some(problem) = &parsed.model
            && let Err(refusal) = Validator::new(&domain, problem)
            && matches!(*refusal, Verdict::IllFormed(_))
            && self.ill_formed.insert(provider)
            && let Some(finding) = explain(&domain, problem, &SequentialPlan::default(), &refusal)
        {
            self.tallies[provider].errors += 1;
            Message::error(finding.sentence)
                .at(&self.files[provider].source, finding.place.span)
                .show(console);
        }
        self.domains[provider] = Some(domain);
    }
}

#[derive(Serialize)]
struct CheckedRecord<'a> {
    kind: &'static str,
    file: &'a str,
    #[serde(flatten)]
    tally: Tally,
}

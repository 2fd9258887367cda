//! `pelea check --summary PATH...`: reports the files of a collection that can be parsed.
//!
//! A line per file, `parsed` or `failed` with the first reason, then totals by folder (the folders in the given
//! paths) and kind. Domains are found by their place and the names of files (`project`), since a collection has many
//! domains of one name. Lints do not run, and a mission is a folder like others. A domain with all its problems and
//! their plans is one piece of work. The machine's cores take the pieces one by one, and each holds at most one problem
//! in memory. As JSON:
//!
//! ```json
//! {"kind": "parsed", "file": "a/p1.pddl", "what": "problem", "parsed": false,
//!  "reason": "4:3: E0202: unknown predicate `lti`", "unsupported": []}
//! {"kind": "summary", "folder": "a", "domains": {"parsed": 1, "files": 1}, "problems": {…}, "plans": {…}}
//! ```
//!
//! The last summary has `null` for its folder and counts everything.

use crate::console::Console;
use crate::exit::Exit;
use crate::files;
use crate::nearby::entries;
use crate::pool;
use crate::render;
use pddl::model::{Domain, Problem};
use pddl::{Diagnostic, Severity, Source, parse_domain, parse_plan, parse_problem};
use project::{Candidate, FileKind, Header, domain_for, problem_for};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// A file of the collection.
struct Entry {
    path: PathBuf,
    kind: FileKind,
    name: String,
    needs: Vec<String>,
    /// The folder that it is counted in.
    folder: String,
}

/// The outcome of a file.
#[derive(Clone, Debug, Default)]
struct Outcome {
    /// The reason why it could not be read.
    failed: Option<String>,
    /// Parsed features of the language that have no model.
    unsupported: Vec<String>,
}

impl Outcome {
    fn failed(reason: impl Into<String>) -> Self {
        Self { failed: Some(reason.into()), unsupported: Vec::new() }
    }

    fn of(source: &Source, diagnostics: &[Diagnostic]) -> Self {
        let failed = diagnostics.iter().find(|d| d.severity == Severity::Error).map(|d| {
            let place = source.line_column(d.span.start);
            format!("{}:{}: {}: {}", place.line, place.column, d.code(), d.message())
        });
        let mut unsupported: Vec<String> = diagnostics
            .iter()
            .filter(|d| d.severity == Severity::Unsupported)
            .map(Diagnostic::message)
            .collect();
        unsupported.sort();
        unsupported.dedup();
        Self { failed, unsupported }
    }
}

pub(super) fn run(paths: &[PathBuf], console: &mut Console<'_>) -> Exit {
    let mut exit = Exit::Yes;
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            below(path, path, &mut found);
        } else if path.is_file() {
            found.push((path.clone(), folder_of(path.parent().unwrap_or(path), path)));
        } else {
            render::error(format!("cannot read `{}`: there is no such file", path.display()), console);
            exit = exit.and(Exit::Unreadable);
        }
    }
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut entries: Vec<Entry> = Vec::new();
    let mut seen = BTreeSet::new();
    for (path, folder) in found {
        if !seen.insert(path.clone()) {
            continue;
        }
        let (entry, outcome) = entry(path, folder);
        entries.push(entry);
        outcomes.push(outcome);
    }
    let collection = Collection::new(&entries);
    collection.read(&mut outcomes);
    let mut totals: BTreeMap<&str, Totals> = BTreeMap::new();
    let mut all = Totals::default();
    for (entry, outcome) in entries.iter().zip(&outcomes) {
        all.count(entry.kind, outcome);
        totals.entry(&entry.folder).or_default().count(entry.kind, outcome);
        console.result(&line(entry, outcome));
        console.record(&FileRecord {
            kind: "parsed",
            file: &entry.path.display().to_string(),
            what: word(entry.kind),
            parsed: outcome.failed.is_none(),
            reason: outcome.failed.as_deref(),
            unsupported: &outcome.unsupported,
        });
        if outcome.failed.is_some() {
            exit = exit.and(Exit::No);
        }
    }
    for (folder, totals) in totals.iter().map(|(f, t)| (Some(*f), t)).chain([(None, &all)]) {
        console.result(&format!("{}: {}", folder.unwrap_or("total"), totals.text()));
        console.record(&SummaryRecord { kind: "summary", folder, totals });
    }
    exit
}

/// All PDDL, HDDL and plan files below a folder, each with the folder that it is counted in.
fn below(root: &Path, folder: &Path, found: &mut Vec<(PathBuf, String)>) {
    for path in entries(folder) {
        if path.is_dir() && !path.is_symlink() {
            below(root, &path, found);
        } else if path.is_file() && FileKind::is_source(&path.to_string_lossy()) {
            let folder = folder_of(root, &path);
            found.push((path, folder));
        }
    }
}

/// The folder in `root` that a file is in; `root` itself for a file directly in it.
fn folder_of(root: &Path, path: &Path) -> String {
    let inside = path.parent().and_then(|p| p.strip_prefix(root).ok()).and_then(|p| p.components().next());
    let folder = inside.map_or_else(|| root.to_owned(), |first| root.join(first));
    if folder.as_os_str().is_empty() { ".".to_owned() } else { folder.display().to_string() }
}

fn entry(path: PathBuf, folder: String) -> (Entry, Outcome) {
    let (header, outcome) = match files::read(&path) {
        Ok(source) => (Header::of(source.name(), source.text()), Outcome::default()),
        Err(error) => (Header::of("", ""), Outcome::failed(error.to_string())),
    };
    let needs = header.needs.into_iter().map(|need| need.name).collect();
    (Entry { path, kind: header.kind, name: header.name, needs, folder }, outcome)
}

/// The files that belong together.
struct Collection<'a> {
    entries: &'a [Entry],
    /// The problems of each domain, and the plans of each problem.
    members: Vec<Vec<usize>>,
    /// Files that belong to no other file.
    stray: Vec<usize>,
    domains: Vec<usize>,
}

impl<'a> Collection<'a> {
    fn new(entries: &'a [Entry]) -> Self {
        let of = |kind| (0..entries.len()).filter(move |&i| entries[i].kind == kind);
        let domains: Vec<usize> = of(FileKind::Domain).collect();
        let problems: Vec<usize> = of(FileKind::Problem).collect();
        let candidates: Vec<Candidate<'_>> =
            domains.iter().map(|&i| Candidate { path: &entries[i].path, name: &entries[i].name }).collect();
        let paths: Vec<&Path> = problems.iter().map(|&i| entries[i].path.as_path()).collect();
        let mut members = vec![Vec::new(); entries.len()];
        let mut stray = Vec::new();
        for &problem in &problems {
            let wanted = entries[problem].needs.first().map(String::as_str);
            match domain_for(&entries[problem].path, wanted, &candidates) {
                Some(domain) => members[domains[domain]].push(problem),
                None => stray.push(problem),
            }
        }
        for plan in of(FileKind::Plan) {
            match problem_for(&entries[plan].path, &paths) {
                Some(problem) => members[problems[problem]].push(plan),
                None => stray.push(plan),
            }
        }
        Self { entries, members, stray, domains }
    }

    /// Reads everything, on all cores.
    fn read(&self, outcomes: &mut [Outcome]) {
        let mut results = Vec::new();
        pool::in_order(&self.domains, |&domain| self.domain(domain), |_, found| results.extend(found));
        let strays = self.stray.iter().flat_map(|&index| {
            let what = if self.entries[index].kind == FileKind::Plan { "problem" } else { "domain" };
            self.fail(index, &format!("there is no {what} for it"))
        });
        for (index, outcome) in results.into_iter().chain(strays) {
            // A file that could not be opened has failed already.
            if outcomes[index].failed.is_none() {
                outcomes[index] = outcome;
            }
        }
    }

    /// Marks a file and all files that need it as failed.
    fn fail(&self, index: usize, reason: &str) -> Vec<(usize, Outcome)> {
        let mut outcomes = vec![(index, Outcome::failed(reason))];
        let because = format!("{} has failed", self.entries[index].path.display());
        for &member in &self.members[index] {
            outcomes.extend(self.fail(member, &because));
        }
        outcomes
    }

    fn domain(&self, index: usize) -> Vec<(usize, Outcome)> {
        let imports = self.imports(index, &mut vec![index]);
        let (outcome, domain) = match files::read(&self.entries[index].path) {
            Ok(source) => {
                let parsed = parse_domain(&source, &imports.iter().collect::<Vec<_>>());
                (Outcome::of(&source, &parsed.diagnostics), parsed.model)
            }
            Err(error) => (Outcome::failed(error.to_string()), None),
        };
        let Some(domain) = domain else {
            let reason = outcome.failed.unwrap_or_else(|| "it has no model".to_owned());
            return self.fail(index, &reason);
        };
        let mut outcomes = vec![(index, outcome)];
        for &problem in &self.members[index] {
            outcomes.extend(self.problem(problem, &domain));
        }
        outcomes
    }

    /// The domains that a domain imports, as far as they can be read; the parser reports a missing one.
    fn imports(&self, index: usize, seen: &mut Vec<usize>) -> Vec<Domain> {
        let mut imports = Vec::new();
        for name in &self.entries[index].needs {
            let common = |&i: &usize| {
                let parts = self.entries[i].path.components().zip(self.entries[index].path.components());
                parts.take_while(|(a, b)| a == b).count()
            };
            let named = self.domains.iter().copied().filter(|&i| self.entries[i].name == *name);
            let Some(import) = named.max_by_key(common).filter(|i| !seen.contains(i)) else { continue };
            seen.push(import);
            let own = self.imports(import, seen);
            if let Ok(source) = files::read(&self.entries[import].path) {
                imports.extend(parse_domain(&source, &own.iter().collect::<Vec<_>>()).model);
            }
            imports.extend(own);
            seen.pop();
        }
        imports
    }

    fn problem(&self, index: usize, domain: &Domain) -> Vec<(usize, Outcome)> {
        let (outcome, problem) = match files::read(&self.entries[index].path) {
            Ok(source) => {
                let parsed = parse_problem(&source, domain);
                (Outcome::of(&source, &parsed.diagnostics), parsed.model)
            }
            Err(error) => (Outcome::failed(error.to_string()), None),
        };
        let Some(problem) = problem else {
            let reason = outcome.failed.unwrap_or_else(|| "it has no model".to_owned());
            return self.fail(index, &reason);
        };
        let mut outcomes = vec![(index, outcome)];
        for &plan in &self.members[index] {
            outcomes.push((plan, self.plan(plan, domain, &problem)));
        }
        outcomes
    }

    fn plan(&self, index: usize, domain: &Domain, problem: &Problem) -> Outcome {
        match files::read(&self.entries[index].path) {
            Ok(source) => Outcome::of(&source, &parse_plan(&source, domain, problem).diagnostics),
            Err(error) => Outcome::failed(error.to_string()),
        }
    }
}

fn line(entry: &Entry, outcome: &Outcome) -> String {
    let path = entry.path.display();
    match (&outcome.failed, outcome.unsupported.as_slice()) {
        (Some(reason), _) => format!("{path}: failed: {reason}"),
        (None, []) => format!("{path}: parsed"),
        (None, unsupported) => format!("{path}: parsed, but {}", unsupported.join(", ")),
    }
}

fn word(kind: FileKind) -> &'static str {
    match kind {
        FileKind::Domain => "domain",
        FileKind::Problem => "problem",
        FileKind::Plan => "plan",
    }
}

/// The number of files of a kind, and how many of them were parsed.
#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Total {
    parsed: usize,
    files: usize,
}

#[derive(Clone, Copy, Debug, Default, Serialize)]
struct Totals {
    domains: Total,
    problems: Total,
    plans: Total,
}

impl Totals {
    fn count(&mut self, kind: FileKind, outcome: &Outcome) {
        let total = match kind {
            FileKind::Domain => &mut self.domains,
            FileKind::Problem => &mut self.problems,
            FileKind::Plan => &mut self.plans,
        };
        total.files += 1;
        total.parsed += usize::from(outcome.failed.is_none());
    }

    /// `3 of 3 domains, 11 of 12 problems parsed`
    fn text(&self) -> String {
        let parts = [(self.domains, "domains"), (self.problems, "problems"), (self.plans, "plans")];
        let parts: Vec<String> = parts
            .iter()
            .filter(|(total, _)| total.files > 0)
            .map(|(total, word)| format!("{} of {} {word}", total.parsed, total.files))
            .collect();
        if parts.is_empty() { "no files".to_owned() } else { format!("{} parsed", parts.join(", ")) }
    }
}

#[derive(Serialize)]
struct FileRecord<'a> {
    kind: &'static str,
    file: &'a str,
    what: &'static str,
    parsed: bool,
    reason: Option<&'a str>,
    unsupported: &'a [String],
}

#[derive(Serialize)]
struct SummaryRecord<'a> {
    kind: &'static str,
    folder: Option<&'a str>,
    #[serde(flatten)]
    totals: &'a Totals,
}

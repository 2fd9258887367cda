//! A first `expected.toml`, from the present results.
//!
//! Problem: an author with a domain and some plans should not have to write what a program can find out. Idea: the draft
//! states the present results; the author reads it and corrects what is not intended. Invariant: a suite passes with its
//! draft, unless a plan in a folder `valid` is invalid, which a draft does not hide.

use crate::Fault;
use crate::Folder;
use crate::expected::Verdict;
use crate::folder::{last_folder, stem, without_extension};
use crate::found::Found;
use crate::solve::{Answer, Clock, Means, Question};
use crate::suite::{Suite, problem_of};
use pddl::Source;
use planner::{Budget, SearchConfiguration};
use project::FileKind;
use std::fmt::Write as _;
use std::time::Duration;

/// The text of an `expected.toml` that passes; each question to the planner ends after `timeout`. The text in
/// `folder.expected` is ignored.
pub fn draft(folder: Folder, timeout: Duration, clock: &Clock<'_>, budget: &Budget<'_>) -> String {
    let means = Means { clock, budget };
    let mut files: Vec<_> =
        folder.files.iter().map(|f| (f.path.clone(), f.source.name().to_owned())).collect();
    files.sort();
    let expected = Source::new(folder.expected.name(), "");
    let suite = Suite::read(Folder { expected, ..folder });
    let mut text = String::from("# What is expected of this folder: docs/testing.md.\n");
    let ids: Vec<_> =
        files.iter().filter_map(|(path, name)| Some((suite.project.id(name)?, path.clone()))).collect();
    let project = &suite.project;
    let of_kind = |kind| ids.iter().filter(move |(id, _)| project.kind(*id) == kind);
    let key = |path: &str| {
        let alike = ids.iter().filter(|(_, other)| stem(other) == stem(path)).count();
        quoted(if alike == 1 { stem(path) } else { without_extension(path) })
    };
    let mut diagnostics = String::new();
    for (id, path) in of_kind(FileKind::Domain).chain(of_kind(FileKind::Problem)) {
        let found = suite.project.findings(*id);
        if !found.is_empty() {
            let line = |f: &diagnostics::Finding| suite.source(*id).line_column(f.place.span.start).line;
            let codes: Vec<_> =
                found.iter().filter_map(|f| Some(format!("\"{} at {}\"", f.code?, line(f)))).collect();
            let _ = writeln!(diagnostics, "{} = [{}]", key(path), codes.join(", "));
        }
    }
    if !diagnostics.is_empty() {
        let _ = write!(text, "\n[diagnostics]\n{diagnostics}");
    }
    let problems: Vec<_> = of_kind(FileKind::Problem).cloned().collect();
    for (id, path) in &problems {
        let Ok(task) = suite.task(*id) else { continue };
        let end = clock().saturating_add(timeout);
        let over = || clock() >= end;
        let asked = Question { task: &task, means: &means, over: &over };
        let says = match asked.answer(task.problem, SearchConfiguration::best_optimal()) {
            Answer::Plan(_, valid) => format!("optimal-cost = {}", valid.cost()),
            Answer::Unsolvable => "solvable = false".to_owned(),
            Answer::Unknown(_) => {
                let over = || clock() >= end.saturating_add(timeout);
                let asked = Question { task: &task, means: &means, over: &over };
                match asked.answer(task.problem, SearchConfiguration::default()) {
                    Answer::Plan(_, valid) => format!("cost-at-most = {}", valid.cost()),
                    Answer::Unsolvable => "solvable = false".to_owned(),
                    _ => continue,
                }
            }
            Answer::Unsupported { .. } | Answer::NotValid(_) => continue,
        };
        let _ = write!(text, "\n[problem.{}]\n{says}\n", key(path));
    }
    for (id, path) in of_kind(FileKind::Plan) {
        let Some(problem) = problem_of(path, &problems) else {
            let _ =
                write!(text, "\n# {path}: which problem is it for? [plan.{}] problem = \"…\"\n", key(path));
            continue;
        };
        let Ok(task) = suite.task(problem) else { continue };
        let by_folder = last_folder(path).and_then(Verdict::of_word);
        let mut lines = plan_lines(&suite.found(&task, *id), by_folder);
        lines.retain(|line| !line.is_empty());
        if !lines.is_empty() {
            let _ = write!(text, "\n[plan.{}]\n{}\n", key(path), lines.join("\n"));
        }
    }
    text
}

fn plan_lines(found: &Found, by_folder: Option<Verdict>) -> Vec<String> {
    let verdict = match found {
        Found::Valid { .. } => Verdict::Valid,
        Found::Invalid { .. } | Found::Unreadable { .. } => Verdict::Invalid,
        Found::Unsupported { .. } => Verdict::Unsupported,
    };
    if by_folder == Some(Verdict::Valid) && verdict == Verdict::Invalid {
        return Vec::new();
    }
    let mut lines = Vec::new();
    if by_folder != Some(verdict) {
        lines.push(format!("verdict = \"{}\"", verdict.word()));
    }
    match found {
        Found::Valid { cost } => lines.extend(decimal(*cost).map(|cost| format!("cost = {cost}"))),
        Found::Invalid { fault, step, missing, .. } => {
            lines.push(format!("why = \"{fault}\""));
            lines.extend(step.map(|step| format!("step = {step}")));
            match missing.as_slice() {
                [] => {}
                [one] => lines.push(format!("missing = {}", string(one))),
                several => {
                    let all: Vec<_> = several.iter().map(|literal| string(literal)).collect();
                    lines.push(format!("missing = [{}]", all.join(", ")));
                }
            }
        }
        Found::Unreadable { errors, .. } => {
            if let Some((code, line)) = errors.first() {
                let word = Fault::of_code(code).map_or(*code, Fault::word);
                lines.push(format!("why = \"{word}\"\nline = {line}"));
            }
        }
        Found::Unsupported { .. } => {}
    }
    lines
}

/// A number as TOML writes it; `None` for a fraction that has no short decimal form.
fn decimal(number: validator::Number) -> Option<String> {
    let text = number.to_string();
    text.parse::<f64>().is_ok().then_some(text)
}

fn string(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A key, bare if it may be.
fn quoted(key: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
    if !key.is_empty() && key.chars().all(bare) { key.to_owned() } else { string(key) }
}

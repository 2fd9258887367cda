//! What several test files share: finding files, and comparing models without their spans.
#![allow(dead_code, reason = "each test file uses a part of it")]

pub(crate) mod properties;

use std::path::{Path, PathBuf};

use pddl::model::{Domain, Problem};
use pddl::{
    Diagnostic, Plan, Source, parse_domain, parse_plan, parse_problem, print_domain, print_plan,
    print_problem,
};

/// All PDDL, HDDL and plan files below a folder, in order of their paths.
pub(crate) fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the folder can be read") {
            let path = entry.expect("the folder can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "pddl" || e == "hddl" || e == "plan") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The model as text, without spans.
pub(crate) fn without_spans(model: &impl std::fmt::Debug) -> String {
    let text = format!("{model:?}");
    let mut parts = text.split("Span { start: ");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + "Span {" + part.split_once('}').map_or("", |(_, rest)| rest))
}

fn describe(source: &Source, diagnostics: &[Diagnostic]) -> String {
    diagnostics.iter().map(|d| d.describe(source)).collect::<String>() + source.text()
}

/// Reading what is printed gives the same domain.
pub(crate) fn check_domain_printed(domain: &Domain, imports: &[&Domain]) {
    let source = Source::new("printed", print_domain(domain));
    let again = parse_domain(&source, imports);
    let Some(model) = again.model else { panic!("{}", describe(&source, &again.diagnostics)) };
    if domain.unsupported.is_empty() {
        similar(&without_spans(domain), &without_spans(&model), source.text());
        assert_eq!(source.text(), print_domain(&model));
    }
}

/// Reading what is printed gives the same problem.
pub(crate) fn check_problem_printed(problem: &Problem, domain: &Domain) {
    let source = Source::new("printed", print_problem(problem, domain));
    let again = parse_problem(&source, domain);
    let Some(model) = again.model else { panic!("{}", describe(&source, &again.diagnostics)) };
    if problem.unsupported.is_empty() {
        similar(&without_spans(problem), &without_spans(&model), source.text());
        assert_eq!(source.text(), print_problem(&model, domain));
    }
}

/// Reading what is printed gives the same plan.
pub(crate) fn check_plan_printed(plan: &Plan, domain: &Domain, problem: &Problem) {
    let source = Source::new("printed", print_plan(plan, domain, problem));
    let again = parse_plan(&source, domain, problem);
    let Some(model) = again.model else { panic!("{}", describe(&source, &again.diagnostics)) };
    similar(&without_spans(plan), &without_spans(&model), source.text());
    assert_eq!(source.text(), print_plan(&model, domain, problem));
}

/// Models are long: of two that differ it shows where.
fn similar(a: &str, b: &str, printed: &str) {
    let same = a.bytes().zip(b.bytes()).take_while(|(x, y)| x == y).count();
    let from = same.saturating_sub(80);
    let part = |s: &str| s.chars().skip(from).take(240).collect::<String>();
    assert!(a == b, "printing changed the model:\n{}\n{}\n{printed}", part(a), part(b));
}

//! Every folder of `test_data/`: a domain, a problem, plans, and what is to be said about each plan.
//!
//! `UPDATE_EXPECT=1 cargo test -p pelea-validator` writes the `expected` files anew; read the difference.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::{Diagnostic, Source, Span, parse_domain, parse_plan, parse_problem};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use validator::{File, Place, Validator, Verdict, explain, show_diff};

fn folders(of: &Path) -> Vec<PathBuf> {
    let mut paths: Vec<_> = std::fs::read_dir(of).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.is_dir());
    paths.sort();
    paths
}

fn source(path: &Path) -> Source {
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    Source::new(name, std::fs::read_to_string(path).unwrap())
}

fn at(source: &Source, span: Span) -> String {
    let place = source.line_column(span.start);
    format!("{}:{}:{}", source.name(), place.line, place.column)
}

fn unreadable(source: &Source, diagnostics: &[Diagnostic]) -> String {
    let mut text = String::from("unreadable\n");
    for diagnostic in diagnostics {
        writeln!(text, "  {} {}", at(source, diagnostic.span), diagnostic.message()).unwrap();
    }
    text
}

fn judge(folder: &Path, plan: &Path) -> String {
    let domain_source = source(&folder.join("domain.pddl"));
    let parsed = parse_domain(&domain_source, &[]);
    let Some(domain) = parsed.model else { return unreadable(&domain_source, &parsed.diagnostics) };
    let problem_source = source(&folder.join("problem.pddl"));
    let parsed = parse_problem(&problem_source, &domain);
    let Some(problem) = parsed.model else { return unreadable(&problem_source, &parsed.diagnostics) };
    let plan_source = source(plan);
    let parsed = parse_plan(&plan_source, &domain, &problem);
    let Some(plan) = parsed.model else { return unreadable(&plan_source, &parsed.diagnostics) };
    let plan = plan.into_sequential().unwrap();
    let place = |place: Place| match place.file {
        File::Domain => at(&domain_source, place.span),
        File::Problem => at(&problem_source, place.span),
        File::Plan => at(&plan_source, place.span),
    };

    let (verdict, trace) = match Validator::new(&domain, &problem) {
        Ok(validator) => validator.trace(&plan),
        Err(refusal) => (*refusal, validator::Trace::default()),
    };
    assert_eq!(verdict, validator::validate(&domain, &problem, &plan), "tracing changes nothing");
    let mut text = match &verdict {
        Verdict::Valid(valid) => format!("valid, {} steps, cost {}\n", valid.steps, valid.cost()),
        Verdict::Invalid(_) => "invalid\n".to_owned(),
        Verdict::Unsupported(_) => "unsupported\n".to_owned(),
        Verdict::IllFormed(_) => "ill-formed\n".to_owned(),
    };
    if let Some(finding) = explain(&domain, &problem, &plan, &verdict) {
        writeln!(text, "  {} {}", place(finding.place), finding.sentence).unwrap();
        for (span, note) in finding.notes {
            writeln!(text, "    {} {note}", place(span)).unwrap();
        }
    }
    if let Some(last) = trace.steps.last() {
        writeln!(text, "  last change: {}", show_diff(&domain, &problem, last).join(", ")).unwrap();
    }
    text
}

#[test]
fn every_case() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data");
    let cases = folders(&root);
    assert!(cases.len() >= 25, "only {} cases in {}", cases.len(), root.display());
    for folder in cases {
        let mut plans: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|e| e.unwrap().path()).collect();
        plans.retain(|p| p.extension().is_some_and(|e| e == "plan"));
        plans.sort();
        assert!(!plans.is_empty(), "{} has no plan", folder.display());
        let mut said = String::new();
        for plan in plans {
            write!(said, "{}: {}", plan.file_name().unwrap().to_string_lossy(), judge(&folder, &plan))
                .unwrap();
        }
        expect_test::expect_file![folder.join("expected")].assert_eq(&said);
    }
}

//! Every file of the competition corpus can be read, printed, and read again to the same model.
//!
//! `PELEA_BENCH` names the folder, by default `../shared/bench` beside the workspace. If it is absent, the
//! test reports that and passes.

mod support;

use std::path::{Path, PathBuf};

use pddl::model::Domain;
use pddl::{Diagnostic, Severity, Source, parse_domain, parse_plan, parse_problem};

/// Files that are not read, each with the reason.
const ALLOWED: &[(&str, &str)] = &[];

fn corpus() -> PathBuf {
    let default = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/bench");
    std::env::var_os("PELEA_BENCH").map_or(default, PathBuf::from)
}

fn source(path: &Path) -> Source {
    Source::from_bytes(path.display().to_string(), std::fs::read(path).expect("the corpus can be read"))
}

/// Descriptions of all errors, none for a file on the allow-list.
fn errors(source: &Source, diagnostics: &[Diagnostic]) -> Vec<String> {
    let allowed = ALLOWED.iter().any(|(end, _)| source.name().ends_with(end));
    let errors = diagnostics.iter().filter(|d| d.severity == Severity::Error && !allowed);
    errors.take(3).map(|d| d.describe(source)).collect()
}

/// The model holds all that the deterministic competitions used.
fn check_whole(source: &Source, diagnostics: &[Diagnostic]) {
    let outside = diagnostics.iter().find(|d| d.severity == Severity::Unsupported);
    assert!(outside.is_none(), "{}", outside.map(|d| d.describe(source)).unwrap_or_default());
}

/// The domain of a folder: the only one, or the one that is named like the problem.
fn domain_of(problem: &Path) -> Option<PathBuf> {
    let folder = problem.parent()?;
    let name = problem.file_name()?.to_str()?;
    let fixed = ["domain.pddl".to_owned(), "domain.hddl".to_owned()];
    let alike = [
        name.replace(".pddl", "-domain.pddl"),
        name.replace("problem", "domain"),
        format!("domain_{name}"),
        format!("domain-{name}"),
    ];
    let near = alike.iter().chain(&fixed).map(|n| folder.join(n)).find(|p| p.is_file() && p != problem);
    near.or_else(|| {
        let above = folder.parent()?.join("domain.hddl");
        above.is_file().then_some(above)
    })
}

#[test]
fn every_file_is_read_and_printed() {
    let folder = corpus();
    if !folder.is_dir() {
        println!("skipped: no corpus in {}", folder.display());
        return;
    }
    let (mut read, mut unsupported, mut failed) = (0, 0, Vec::new());
    let mut domains: std::collections::BTreeMap<PathBuf, Option<Domain>> = std::collections::BTreeMap::new();
    for path in support::files(&folder) {
        let is_plan = path.extension().is_some_and(|e| e == "plan");
        let problem_path = if is_plan { path.with_file_name("problem.pddl") } else { path.clone() };
        let text = source(&problem_path);
        if !text.text().to_ascii_lowercase().contains("(problem") {
            continue;
        }
        let Some(domain_path) = domain_of(&problem_path) else {
            failed.push(format!("{}: no domain beside it\n", path.display()));
            continue;
        };
        let domain = domains.entry(domain_path.clone()).or_insert_with(|| {
            let source = source(&domain_path);
            let parsed = parse_domain(&source, &[]);
            failed.extend(errors(&source, &parsed.diagnostics));
            check_whole(&source, &parsed.diagnostics);
            unsupported += usize::from(parsed.model.as_ref().is_some_and(|d| !d.unsupported.is_empty()));
            read += usize::from(parsed.model.is_some());
            if let Some(domain) = &parsed.model {
                support::check_domain_printed(domain, &[]);
            }
            parsed.model
        });
        let Some(domain) = domain else { continue };
        let parsed = parse_problem(&text, domain);
        if is_plan {
            let source = source(&path);
            let problem = parsed.model.expect("the problem was read before its plans");
            let parsed = parse_plan(&source, domain, &problem);
            failed.extend(errors(&source, &parsed.diagnostics));
            read += usize::from(parsed.model.is_some());
            if let Some(plan) = &parsed.model {
                support::check_plan_printed(plan, domain, &problem);
            }
            continue;
        }
        failed.extend(errors(&text, &parsed.diagnostics));
        if let Some(problem) = &parsed.model {
            support::check_problem_printed(problem, domain);
        }
        check_whole(&text, &parsed.diagnostics);
        unsupported += usize::from(parsed.model.as_ref().is_some_and(|p| !p.unsupported.is_empty()));
        read += usize::from(parsed.model.is_some());
    }
    println!("{read} read ({unsupported} with unsupported features), {} diagnostics", failed.len());
    assert!(failed.is_empty(), "{}", failed.join(""));
    assert!(read > 0, "the corpus holds files");
}

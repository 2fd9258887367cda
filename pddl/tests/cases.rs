//! Cases as files: `test_data/ok` must be read and printed without a diagnostic; reading `test_data/err`
//! must give exactly the diagnostics in the `.expected` file (`.plan.expected` for a plan) beside it
//! (`UPDATE_EXPECT=1` rewrites it).
//!
//! A file holds a domain, a problem for it, or both. A comment `; with FILE` names another file of the
//! folder: a domain to import, or the domain of the problem. A plan is for the problem in the `.pddl` file
//! of its name, or in the one that a comment `; of FILE` names.

mod support;

use std::path::{Path, PathBuf};

use pddl::model::{Domain, Problem};
use pddl::{Diagnostic, Plan, Severity, Source, parse_domain, parse_plan, parse_problem};

fn test_data(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("test_data").join(folder)
}

/// The result of reading one file.
struct Case {
    source: Source,
    imports: Vec<Domain>,
    domain: Option<Domain>,
    problem: Option<Problem>,
    plan: Option<Plan>,
    diagnostics: Vec<Diagnostic>,
}

fn read(path: &Path) -> Case {
    let name = path.file_name().expect("a file has a name").to_string_lossy();
    let bytes = std::fs::read(path).expect("the case can be read");
    let source = Source::from_bytes(name, bytes);
    let with = source.text().lines().filter_map(|l| l.strip_prefix("; with "));
    let mut imports: Vec<Domain> = with.filter_map(|f| read(&path.with_file_name(f.trim())).domain).collect();
    let mut case = Case {
        source: source.clone(),
        imports: Vec::new(),
        domain: None,
        problem: None,
        plan: None,
        diagnostics: Vec::new(),
    };
    let is_problem = source.text().contains("(problem");
    if path.extension().is_some_and(|e| e == "plan") {
        let mut of =
            source.text().lines().filter_map(|l| l.trim_start_matches('\u{feff}').strip_prefix("; of "));
        let of = of.next().map_or_else(|| path.with_extension("pddl"), |f| path.with_file_name(f.trim()));
        let beside = read(&of);
        let (domain, problem) = (beside.domain.expect("a domain"), beside.problem.expect("a problem"));
        let parsed = parse_plan(&source, &domain, &problem);
        case.diagnostics = parsed.diagnostics;
        (case.domain, case.problem, case.plan) = (Some(domain), Some(problem), parsed.model);
        return case;
    }
    if source.text().contains("(domain") || !is_problem {
        let parsed = parse_domain(&source, &imports.iter().collect::<Vec<_>>());
        case.diagnostics.extend(parsed.diagnostics);
        case.domain = parsed.model;
    } else {
        case.domain = imports.pop();
    }
    if let (true, Some(domain)) = (is_problem, &case.domain) {
        let parsed = parse_problem(&source, domain);
        case.diagnostics.extend(parsed.diagnostics);
        case.problem = parsed.model;
    }
    case.diagnostics.sort_by_key(|d| d.span);
    case.diagnostics.dedup();
    case.imports = imports;
    case
}

#[test]
fn good_files_are_read_and_printed() {
    let files = support::files(&test_data("ok"));
    assert!(!files.is_empty());
    let mut failed = String::new();
    for path in files {
        let case = read(&path);
        let said: Vec<String> = case
            .diagnostics
            .iter()
            .filter(|d| d.severity != Severity::Unsupported)
            .map(|d| d.describe(&case.source))
            .collect();
        failed += &said.concat();
        if let Some(domain) = &case.domain {
            support::check_domain_printed(domain, &case.imports.iter().collect::<Vec<_>>());
            if let Some(problem) = &case.problem {
                support::check_problem_printed(problem, domain);
                if path.extension().is_some_and(|e| e == "plan") {
                    support::check_plan_printed(case.plan.as_ref().expect("a plan"), domain, problem);
                }
            }
        }
    }
    assert!(failed.is_empty(), "{failed}");
}

#[test]
fn bad_files_say_what_is_expected() {
    let files = support::files(&test_data("err"));
    assert!(!files.is_empty());
    for path in files {
        let case = read(&path);
        let said: String = case.diagnostics.iter().map(|d| d.describe(&case.source)).collect();
        assert!(!said.is_empty(), "{} is not bad", path.display());
        let is_plan = path.extension().is_some_and(|e| e == "plan");
        let expected = path.with_extension(if is_plan { "plan.expected" } else { "expected" });
        expect_test::expect_file![expected].assert_eq(&said);
    }
}

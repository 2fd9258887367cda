//! The suites of this project pass, and the suites that `pelea test --init` writes pass too.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn pelea(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_pelea")).args(arguments).current_dir(folder).output().unwrap()
}

fn said(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

#[test]
fn our_own_suites_pass() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let output = pelea(&root, &["test", "domains", "validator/test_data"]);
    let said = said(&output);
    assert_eq!(output.status.code(), Some(0), "{said}");
    assert!(said.contains("PASS") && said.contains("domains/barthel/problem.pddl::solvable"), "{said}");
    let plans = said.lines().filter(|line| line.contains("validator/test_data") && line.contains(".plan::"));
    let plans = plans.count();
    assert!(plans >= 150, "only {plans} plans in validator/test_data");
}

#[test]
fn a_first_file_is_written_and_passes() {
    let folder = tempfile::tempdir().unwrap();
    let domain = "(define (domain hall) (:predicates (lit)) (:action switch :effect (lit)))";
    fs::write(folder.path().join("domain.pddl"), domain).unwrap();
    let problem = "(define (problem dark) (:domain hall) (:init) (:goal (lit)))";
    fs::write(folder.path().join("dark.pddl"), problem).unwrap();
    fs::create_dir(folder.path().join("invalid")).unwrap();
    fs::write(folder.path().join("invalid/nothing.plan"), "").unwrap();
    let output = pelea(folder.path(), &["test", "--init", "."]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let written = fs::read_to_string(folder.path().join("expected.toml")).unwrap();
    assert!(written.contains("[problem.dark]\noptimal-cost = 1\n"), "{written}");
    assert!(written.contains("[plan.nothing]\nwhy = \"goal\"\nmissing = \"(lit)\"\n"), "{written}");
    let output = pelea(folder.path(), &["test"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    // What is there is never written over.
    let output = pelea(folder.path(), &["test", "--init", "."]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
}

//! Every folder of `cases/`: the output of the binary.
//!
//! `cmd` holds the arguments, one command a file; the binary runs in a copy of the folder, and its
//! standard output, standard error and exit code must equal the files `stdout`, `stderr` and `exit` (a missing file
//! stands for nothing). A case about a mission holds only the differences: `mission` names a folder of `missions` that is
//! copied too, and in `edits` each block `edit PATH` replaces the one text between `<<<<` and `====` by the text
//! between `====` and `>>>>`. Measured figures are written as `#`. `UPDATE_EXPECT=1 cargo test -p pelea` rewrites the files.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use expect_test::expect_file;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

fn cases() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut cases: Vec<_> = fs::read_dir(root).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.sort();
    cases
}

fn copy(from: &Path, to: &Path) {
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            fs::create_dir(&target).unwrap();
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// The folder of a case, ready to run in.
fn prepare(case: &Path, folder: &Path) {
    if let Ok(mission) = fs::read_to_string(case.join("mission")) {
        let missions = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/missions");
        fs::create_dir(folder.join(mission.trim())).unwrap();
        copy(&missions.join(mission.trim()), &folder.join(mission.trim()));
    }
    copy(case, folder);
    if let Ok(edits) = fs::read_to_string(case.join("edits")) {
        apply(&edits, folder);
    }
}

fn apply(edits: &str, folder: &Path) {
    let mut lines = edits.lines();
    while let Some(line) = lines.next() {
        let Some(path) = line.strip_prefix("edit ") else { continue };
        let path = folder.join(path);
        assert_eq!(lines.next(), Some("<<<<"), "{line}");
        let mut block = |end: &str| lines.by_ref().take_while(|l| *l != end).collect::<Vec<_>>().join("\n");
        let (old, new) = (block("===="), block(">>>>"));
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text.matches(&old).count(), 1, "{line}: {old}");
        fs::write(path, text.replace(&old, &new)).unwrap();
    }
}

/// Times differ from run to run and effort from search to search: `0.123 ms` becomes `# ms`,
/// `12 expanded` becomes `# expanded`, `[   0.012s]` becomes `[#s]`, likewise in JSON.
fn without_measurements(text: &str) -> String {
    const AFTER: [&str; 7] = ["s]", " ms", " facts", " operators", " instances", " expanded", " evaluated"];
    const BEFORE: [&str; 6] =
        ["_ms\":", "\"facts\":", "\"operators\":", "\"expanded\":", "\"evaluated\":", "\"generated\":"];
    let mut kept = String::new();
    let mut rest = text;
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let length =
            rest[start..].find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len() - start);
        let (before, after) = (&rest[..start], &rest[start + length..]);
        let measured =
            AFTER.iter().any(|a| after.starts_with(a)) || BEFORE.iter().any(|b| before.ends_with(b));
        // `[   0.012s]` is as wide whatever was measured; `#` is not.
        kept.push_str(if after.starts_with("s]") { before.trim_end() } else { before });
        kept.push_str(if measured { "#" } else { &rest[start..start + length] });
        rest = after;
    }
    kept + rest
}

fn check(name: &Path, said: &str) {
    if said.is_empty() && !name.exists() {
        return;
    }
    expect_file![name].assert_eq(said);
}

#[test]
fn every_case() {
    let cases = cases();
    assert!(cases.len() >= 20, "only {} cases", cases.len());
    for case in cases {
        let folder = tempfile::tempdir().unwrap();
        prepare(&case, folder.path());
        let arguments = fs::read_to_string(case.join("cmd")).unwrap();
        let output = Command::new(env!("CARGO_BIN_EXE_pelea"))
            .args(arguments.split_whitespace())
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .output()
            .unwrap();
        check(&case.join("stdout"), &without_measurements(&String::from_utf8(output.stdout).unwrap()));
        check(&case.join("stderr"), &without_measurements(&String::from_utf8(output.stderr).unwrap()));
        check(&case.join("exit"), &format!("{}\n", output.status.code().unwrap()));
    }
}

#[test]
fn an_unknown_search_is_told_the_known_ones() {
    let output = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .args(["plan", "domain.pddl", "problem.pddl", "--search", "nothing"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    for known in planner::SearchConfiguration::ALL {
        assert!(said.contains(known.name), "{said}");
    }
}

#[test]
fn a_written_plan_is_the_printed_plan() {
    let folder = tempfile::tempdir().unwrap();
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/plan"), folder.path());
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pelea"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let printed = run(&["plan", "domain.pddl", "problem.pddl", "--optimal"]);
    assert_eq!(run(&["plan", "domain.pddl", "problem.pddl", "--optimal", "-o", "out.plan"]), "");
    assert_eq!(fs::read_to_string(folder.path().join("out.plan")).unwrap(), printed);
    assert!(run(&["validate", "domain.pddl", "problem.pddl", "out.plan"]).contains("valid"));
}

#[test]
fn better_plans_are_written_one_after_the_other() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write(
        "domain.pddl",
        "(define (domain ways) (:requirements :strips :action-costs)
          (:predicates (at0) (at1) (at2) (at3)) (:functions (total-cost) - number)
          (:action fly :parameters () :precondition (at0) :effect (and (at3) (increase (total-cost) 10)))
          (:action ride :parameters () :precondition (at0) :effect (and (at1) (increase (total-cost) 2)))
          (:action walk :parameters () :precondition (at1) :effect (and (at2) (increase (total-cost) 2)))
          (:action swim :parameters () :precondition (at2) :effect (and (at3) (increase (total-cost) 2))))",
    );
    write(
        "problem.pddl",
        "(define (problem way) (:domain ways) (:init (at0) (= (total-cost) 0)) (:goal (at3))
          (:metric minimize (total-cost)))",
    );
    let run = |arguments: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_pelea"));
        let output = command.args(arguments).current_dir(folder.path()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap())
    };
    let (_, told) = run(&["plan", "domain.pddl", "problem.pddl", "--anytime", "-o", "out.plan"]);
    assert!(told.contains("plan 2: 3 steps, cost 6") && told.contains("no plan is better"), "{told}");
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    assert_eq!(read("out.plan.1"), "(fly)\n; cost = 10 (general cost)\n");
    assert_eq!(read("out.plan.2"), "(ride)\n(walk)\n(swim)\n; cost = 6 (general cost)\n");
    assert_eq!(read("out.plan"), read("out.plan.2"));
    let (records, _) = run(&["plan", "domain.pddl", "problem.pddl", "--anytime", "--json"]);
    assert_eq!(records.matches("\"better_plan\"").count(), 2, "{records}");
    assert!(records.contains("\"optimal\":true"), "{records}");
}

#[test]
fn a_closed_pipe_is_no_error() {
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/validate-verbose");
    let mut child = Command::new(env!("CARGO_BIN_EXE_pelea"))
        .args(["validate", "domain.pddl", "problem.pddl", "a.plan", "--verbose"])
        .current_dir(case)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(0));
}

#[test]
fn a_repaired_plan_is_written_and_valid() {
    let folder = tempfile::tempdir().unwrap();
    copy(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/validate-advice"), folder.path());
    let code = |plans: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_pelea"))
            .args(["validate", "domain.pddl", "problem.pddl"])
            .args(plans)
            .current_dir(folder.path())
            .output()
            .unwrap();
        output.status.code()
    };
    assert_eq!(code(&["bad.plan", "--fix", "good.plan"]), Some(1), "the plan that was given is invalid");
    assert_eq!(code(&["good.plan"]), Some(0));
    assert_eq!(code(&["bad.plan", "good.plan", "--fix", "other.plan"]), Some(2), "one plan only");
    assert!(!folder.path().join("other.plan").exists());
}

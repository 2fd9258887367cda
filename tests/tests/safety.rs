//! Invariants catch what a robot does wrong: texts with one mistake each, and what a run of them reports.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use cli::Exit;
use pelea_tests::{Said, missions, pelea, root};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// The Barthel mission and its robot, with a text of it changed.
fn mutated(name: &str, file: &str, old: &str, new: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("safety").join(name);
    let _ = fs::remove_dir_all(&folder);
    copy(&root().join("domains"), &folder.join("domains"));
    copy(&root().join("robots"), &folder.join("robots"));
    let path = folder.join(file);
    let text = fs::read_to_string(&path).unwrap();
    assert!(text.contains(old), "{file} has no {old}");
    // The first occurrence: one rule, one mistake.
    fs::write(&path, text.replacen(old, new, 1)).unwrap();
    folder.join("domains/barthel")
}

fn play(mission: &Path, scenario: &str) -> Said {
    pelea(&["run", &mission.to_string_lossy(), "--scenario", scenario, "--speed", "max", "--json"])
}

fn broken(said: &Said) -> Vec<Value> {
    said.result()["broken"].as_array().unwrap_or_else(|| panic!("{}", said.err)).clone()
}

#[test]
fn a_robot_that_talks_to_an_empty_chair_is_reported() {
    let file = "robots/clarc/agents/speech.pddl";
    let mission = mutated("empty-chair", file, "(over all (is_with ?p ?r))", "(at start (is_with ?p ?r))");
    let said = play(&mission, "figure-8");
    assert_eq!(said.exit, Exit::No);
    let broken = broken(&said);
    let first = broken.iter().find(|b| b["invariant"] == "spoken-to-who-is-there").unwrap();
    let lost = said.records().into_iter().find(|r| {
        r["source"] == "graph"
            && r["no_longer"].as_array().unwrap().iter().any(|t| t == "person is with robot")
    });
    assert_eq!(first["version"], lost.unwrap()["version"], "the version in which the person was lost");
    assert_eq!(first["by"], "change");
    assert_eq!(first["binding"]["r"], "robot");
    let record = said.records().into_iter().find(|r| r["source"] == "safety").unwrap();
    assert_eq!(record["event"], "broken", "it is told where it happened, too");
}

#[test]
fn a_robot_that_hears_a_call_for_help_and_calls_nobody_is_reported() {
    let file = "robots/clarc/agents/cgamed.pddl";
    let mission = mutated(
        "nobody-called",
        file,
        "(at start (asks ?p help))",
        "(at start (asks ?p help)) (at start (is_called_for ?c repair))",
    );
    let said = play(&mission, "help");
    assert_eq!(said.exit, Exit::No);
    let found = broken(&said);
    let help =
        found.iter().find(|b| b["invariant"] == "help-is-acted-upon").unwrap_or_else(|| panic!("{found:?}"));
    assert_eq!(help["by"], "time");
    assert_eq!(help["binding"]["p"], "person");
    let asked = said.records().into_iter().find(|r| {
        r["source"] == "graph" && r["now"].as_array().unwrap().iter().any(|t| t == "person asks help")
    });
    let asked = asked.unwrap()["time"].as_f64().unwrap();
    assert!(
        (help["time"].as_f64().unwrap() - asked - 2.0).abs() < 0.002,
        "two seconds after the call for help"
    );
}

#[test]
fn no_scenario_breaks_an_invariant() {
    for (mission, scenarios) in missions() {
        for scenario in scenarios {
            assert_eq!(broken(&play(&mission, &scenario)), Vec::<Value>::new(), "{scenario}");
        }
    }
}

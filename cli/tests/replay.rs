//! A recorded run is replayed to the same decisions, and a replay that differs says where.
#![allow(clippy::unwrap_used, reason = "a test")]

use pelea::{Console, Exit};
use std::fs;
use std::path::{Path, PathBuf};

fn pelea(arguments: &[&str]) -> (Exit, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::new(&mut out, &mut err);
    let exit = pelea::run([&["pelea"][..], arguments].concat(), &mut console);
    drop(console);
    (exit, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

fn barthel() -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../domains/barthel").display().to_string()
}

/// The journal of a run of a scenario.
fn record(folder: &Path, scenario: &str, latency: &str) -> PathBuf {
    let journal = folder.join(scenario);
    let (mission, at) = (barthel(), journal.display().to_string());
    let latency = ["--planning-latency", latency];
    let run = ["run", &mission, "--scenario", scenario, "--speed", "max", "--journal", &at];
    pelea(&[&run[..], &latency[..]].concat());
    journal
}

#[test]
fn every_decision_of_a_run_is_made_again() {
    let folder = tempfile::tempdir().unwrap();
    for (scenario, latency) in
        [("figure-8", "0"), ("everything-lies", "0"), ("two-silences", "0.1..3"), ("abort", "0.5")]
    {
        let journal = record(folder.path(), scenario, latency).display().to_string();
        let (exit, out, err) = pelea(&["replay", &barthel(), &journal]);
        assert_eq!((exit, err.as_str()), (Exit::Yes, ""), "{scenario}: {out}");
        assert!(out.ends_with("every decision as it was recorded\n"), "{scenario}: {out}");
    }
}

#[test]
fn a_replay_stops_at_a_version_and_shows_the_turn() {
    let folder = tempfile::tempdir().unwrap();
    let journal = record(folder.path(), "figure-8", "0").display().to_string();
    let (exit, out, _) = pelea(&["replay", &barthel(), &journal, "--at", "106"]);
    assert_eq!(exit, Exit::Yes);
    assert!(out.contains("because  (present person) no longer holds"), "{out}");
    assert!(out.contains("version 106"), "{out}");
}

#[test]
fn a_decision_that_is_not_the_recorded_one_is_shown_with_both() {
    let folder = tempfile::tempdir().unwrap();
    let journal = record(folder.path(), "figure-8", "0");
    let turns = journal.join("turns.jsonl");
    let text = fs::read_to_string(&turns).unwrap().replacen("\"introduce\"", "\"describe\"", 1);
    fs::write(&turns, text).unwrap();
    let (exit, out, _) = pelea(&["replay", &barthel(), &journal.display().to_string()]);
    assert_eq!(exit, Exit::No);
    assert!(out.contains("differs\n  recorded: ") && out.contains("\n  replayed: "), "{out}");
}

#[test]
fn a_journal_without_turns_and_a_line_that_is_none_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let journal = record(folder.path(), "figure-8", "0");
    let turns = journal.join("turns.jsonl");
    let text = fs::read_to_string(&turns).unwrap();
    fs::write(&turns, text.replacen("{\"turn\":", "turn", 1)).unwrap();
    let at = journal.display().to_string();
    let (exit, _, err) = pelea(&["replay", &barthel(), &at]);
    assert_eq!(exit, Exit::Unreadable);
    assert!(err.contains("line 2 of `turns.jsonl` is no turn"), "{err}");
    // A crash cuts the last line short: what is before it is replayed.
    fs::write(&turns, &text[..text.len() - 40]).unwrap();
    let (exit, _, err) = pelea(&["replay", &barthel(), &at]);
    assert_eq!(
        (exit, err.as_str()),
        (Exit::Yes, "the record has no end: the run was cut off, or still goes on\n")
    );
    // A turn that is missing is no equal run.
    let gap: String = text
        .lines()
        .enumerate()
        .filter(|(at, _)| *at != 50)
        .fold(String::new(), |all, (_, line)| all + line + "\n");
    fs::write(&turns, gap).unwrap();
    let (exit, _, err) = pelea(&["replay", &barthel(), &at]);
    assert_eq!(exit, Exit::Unreadable);
    assert!(err.contains("missing in `turns.jsonl` after turn 49"), "{err}");
    fs::remove_file(&turns).unwrap();
    let (exit, _, err) = pelea(&["replay", &barthel(), &at]);
    assert_eq!(exit, Exit::Unreadable);
    assert!(err.contains("turns.jsonl"), "{err}");
}

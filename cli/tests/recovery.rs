//! A run that goes on: with which texts, and what would have been with another graph.
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

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() { copy(&path, &target) } else { _ = fs::copy(&path, &target).unwrap() }
    }
}

/// A copy of the Barthel mission with its robot, and the journal of a run of it.
fn recorded(folder: &Path) -> (PathBuf, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for part in ["domains", "robots"] {
        copy(&root.join(part), &folder.join(part));
    }
    let (mission, journal) = (folder.join("domains/barthel"), folder.join("journal").display().to_string());
    let at = mission.display().to_string();
    let run = ["run", &at, "--scenario", "figure-8", "--speed", "max", "--journal", &journal];
    assert_eq!(pelea(&run).0, Exit::Yes);
    (mission, journal)
}

#[test]
fn a_run_goes_on_with_the_texts_that_it_began_with() {
    let folder = tempfile::tempdir().unwrap();
    let (mission, journal) = recorded(folder.path());
    let at = mission.display().to_string();
    let resume = |more: &[&str]| {
        let run = ["run", &at, "--scenario", "figure-8", "--speed", "max", "--resume", &journal];
        pelea(&[&run[..], more].concat())
    };
    let append = |file: &str, text: &str| {
        let path = mission.join(file);
        fs::write(&path, fs::read_to_string(&path).unwrap() + text).unwrap();
    };
    let (exit, out, err) = resume(&[]);
    assert_eq!((exit, err.as_str()), (Exit::Yes, ""), "{out}");
    append("content/en.toml", "# changed");
    let (exit, _, err) = resume(&[]);
    assert_eq!(
        (exit, err.contains("changed since the run began: `content/en.toml`")),
        (Exit::Yes, true),
        "{err}"
    );
    append("methods.hddl", "; changed");
    let (exit, _, err) = resume(&[]);
    assert_eq!((exit, err.contains("`methods.hddl`; `--changed-texts`")), (Exit::Unreadable, true), "{err}");
    assert_eq!(resume(&["--changed-texts"]).0, Exit::Yes);
    append("graph.pddl", "; changed");
    let (exit, _, err) = resume(&["--changed-texts"]);
    assert_eq!((exit, err.contains("`graph.pddl`: begin a new run")), (Exit::Unreadable, true), "{err}");
}

#[test]
fn a_folder_without_a_run_cannot_go_on_and_one_with_a_run_cannot_begin() {
    let folder = tempfile::tempdir().unwrap();
    let (mission, journal) = recorded(folder.path());
    let (at, empty) = (mission.display().to_string(), folder.path().display().to_string());
    let (exit, _, err) = pelea(&["run", &at, "--speed", "max", "--resume", &empty]);
    assert_eq!((exit, err.contains("turns.jsonl")), (Exit::Unreadable, true), "{err}");
    assert_eq!(pelea(&["run", &at, "--speed", "max", "--journal", &journal]).0, Exit::Unwritable);
}

#[test]
fn a_replay_says_which_versions_there_are() {
    let folder = tempfile::tempdir().unwrap();
    let (mission, journal) = recorded(folder.path());
    let replay = |at: &str| pelea(&["replay", &mission.display().to_string(), &journal, "--at", at]);
    let (exit, _, err) = replay("99999");
    assert_eq!(
        (exit, err.contains("no version 99999: there are versions 1 to ")),
        (Exit::Unreadable, true),
        "{err}"
    );
    let (exit, out, err) = replay("12.5s");
    assert_eq!((exit, out.contains("turn     on version")), (Exit::Yes, true), "{out}{err}");
}

#[test]
fn what_if_shows_the_decisions_that_an_edit_changes() {
    let folder = tempfile::tempdir().unwrap();
    let (mission, journal) = recorded(folder.path());
    let at = mission.display().to_string();
    let ask = |edit: &str| {
        let replay = ["replay", &at, &journal, "--scenario", "figure-8", "--from", "60", "--edit", edit];
        pelea(&replay)
    };
    let (exit, out, err) = ask("+ person asks help");
    assert_eq!((exit, err.as_str()), (Exit::No, ""));
    let (_, with) = out.split_once("with the edit:").unwrap();
    assert!(with.contains("(get-help person)"), "{out}");
    // Nothing is removed where nothing is.
    let (exit, out, _) = ask("- person asks help");
    assert_eq!(exit, Exit::Yes, "{out}");
    let (exit, _, err) = ask("+ persn asks help");
    assert_eq!((exit, err.contains("no node `persn`")), (Exit::Unreadable, true), "{err}");
    assert_eq!(ask("person asks help").0, Exit::Unreadable);
}

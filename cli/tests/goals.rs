//! Every scenario of the mission with several goals meets its expectations, and is replayed to the same decisions.
#![allow(clippy::unwrap_used, reason = "a test")]

use pelea::{Console, Exit};
use std::fs;
use std::path::Path;

fn pelea(arguments: &[&str]) -> (Exit, String, String) {
    let (mut out, mut err) = (Vec::new(), Vec::new());
    let mut console = Console::new(&mut out, &mut err);
    let exit = pelea::run([&["pelea"][..], arguments].concat(), &mut console);
    drop(console);
    (exit, String::from_utf8(out).unwrap(), String::from_utf8(err).unwrap())
}

#[test]
fn every_scenario_ends_as_expected_and_is_replayed() {
    let mission = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/missions/host");
    let folder = tempfile::tempdir().unwrap();
    let mut names: Vec<_> = fs::read_dir(mission.join("scenarios"))
        .unwrap()
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    assert!(names.len() > 4, "{names:?}");
    let mission = mission.display().to_string();
    for name in names {
        let journal = folder.path().join(&name).display().to_string();
        let run = ["run", &mission, "--scenario", &name, "--speed", "max", "--journal", &journal];
        let (exit, out, err) = pelea(&run);
        assert_eq!((exit, err.as_str()), (Exit::Yes, ""), "{name}: {out}");
        let (exit, out, err) = pelea(&["replay", &mission, &journal]);
        assert_eq!((exit, err.as_str()), (Exit::Yes, ""), "{name}: {out}");
        assert!(out.ends_with("every decision as it was recorded\n"), "{name}: {out}");
    }
}

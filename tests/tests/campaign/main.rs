//! A campaign: random scenarios from seeds, each run to its end and checked for invariants.
//!
//! Problem: the scenarios in a mission's folder cover only the cases that their authors thought of. Idea:
//! generate patients, clinicians and one to four disruptions at any time, step or condition from a seed;
//! run each as a file through the command line; and check the invariants of every run (`invariants`)
//! instead of one outcome. A finding names its seed: `CAMPAIGN_SEEDS=1234..1235` repeats the run and keeps
//! its file. Cost: about 50 ms a run. 60 runs are always executed; `CAMPAIGN_SEEDS=0..5000` executes more.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod dice;
mod invariants;
mod scenario;

use cli::Exit;
use pelea_tests::{pelea, root};
use std::ops::Range;
use std::path::PathBuf;

/// What is played without being asked for.
const ALWAYS: Range<u64> = 0..60;

fn seeds() -> Range<u64> {
    let Ok(wanted) = std::env::var("CAMPAIGN_SEEDS") else { return ALWAYS };
    let (from, to) = wanted.split_once("..").expect("CAMPAIGN_SEEDS is FROM..TO");
    from.parse().unwrap()..to.parse().unwrap()
}

fn file(seed: u64) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("campaign");
    std::fs::create_dir_all(&folder).unwrap();
    folder.join(format!("seed-{seed}.toml"))
}

/// Plays the scenario of a seed, and says what was wrong with the run.
fn play(seed: u64) -> Vec<String> {
    let made_up = scenario::make_up(seed);
    let file = file(seed);
    std::fs::write(&file, &made_up.text).unwrap();
    let mission = root().join("domains/barthel");
    let (mission, path) = (mission.to_string_lossy(), file.to_string_lossy());
    let said = pelea(&["run", &mission, "--scenario", &path, "--speed", "max", "--json"]);
    if !matches!(said.exit, Exit::Yes | Exit::No) {
        return vec![format!("exit {:?}: {}", said.exit, said.err)];
    }
    let broken = invariants::broken(&said.records(), &made_up);
    if broken.is_empty() {
        std::fs::remove_file(&file).unwrap();
    }
    broken
}

#[test]
fn whatever_happens_every_run_keeps_what_it_owes_the_patient() {
    let mut findings = Vec::new();
    for seed in seeds() {
        for broken in play(seed) {
            // Told at once: a long campaign may be stopped before its end.
            eprintln!("seed {seed}: {broken}");
            findings.push(format!("seed {seed}: {broken}"));
        }
    }
    assert!(findings.is_empty(), "{} findings\n{}", findings.len(), findings.join("\n"));
}

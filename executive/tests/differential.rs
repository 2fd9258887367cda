//! Monitoring says of each suffix what the validator says, whichever fact turns round.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod flips;

use flips::{COLUMNS, Limits, Sweep, sweep};
use std::path::{Path, PathBuf};

/// The domains of the planner's tests and the mission: each folder with its problems.
fn tasks() -> Vec<(PathBuf, PathBuf)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut folders: Vec<PathBuf> = std::fs::read_dir(root.join("planner/test_data"))
        .unwrap()
        .chain(std::fs::read_dir(root.join("domains")).unwrap())
        .map(|entry| entry.unwrap().path())
        .collect();
    folders.sort();
    let mut tasks = Vec::new();
    for folder in folders {
        let domain = folder.join("domain.pddl");
        let mut problems: Vec<_> =
            std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        problems.sort();
        // What is no problem of this domain is left out by the sweep.
        problems.retain(|path| path.extension().is_some_and(|e| e == "pddl") && *path != domain);
        tasks.extend(problems.into_iter().map(|problem| (domain.clone(), problem)));
    }
    tasks
}

#[test]
fn every_fact_turned_round_is_judged_as_the_validator_judges_it() {
    let limits = Limits { expansions: 20_000, judged: 4_000 };
    let mut sweeps: Vec<Sweep> = Vec::new();
    for (domain, problem) in tasks() {
        match sweep(&domain, &problem, limits) {
            Ok(sweep) => {
                eprintln!("{}: {COLUMNS}: {sweep}", problem.display());
                assert!(sweep.wrong.is_empty(), "{}: {:#?}", problem.display(), sweep.wrong);
                assert_eq!(sweep.exact_from, 0, "{}: a suffix is simulated", problem.display());
                sweeps.push(sweep);
            }
            Err(why) => eprintln!("{} left out: {why}", problem.display()),
        }
    }
    // The comparison covers what regression is for.
    let with = |count: fn(&Sweep) -> usize| sweeps.iter().filter(|s| s.matter > 0 && count(s) > 0).count();
    assert!(with(|s| s.conditional) >= 2, "conditional effects: {sweeps:#?}");
    assert!(with(|s| s.numeric) >= 2, "changing numbers: {sweeps:#?}");
    assert!(with(|s| s.derived) >= 2, "axioms: {sweeps:#?}");
}

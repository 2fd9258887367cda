//! The project's own suites: every invalid plan is invalid in one way, which is named, and would be valid without it.
//!
//! `pelea test` holds what is named against what is found; here only is seen that something is named: the kind of the
//! fault and a detail, and that a plan for the same task, or for one beside it, passes. And every kind of fault that
//! there is has a plan.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use suite::Fault;

fn suites() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let folders = ["validator/test_data", "domains"].map(|folder| fs::read_dir(root.join(folder)).unwrap());
    let mut suites: Vec<PathBuf> = folders.into_iter().flatten().map(|entry| entry.unwrap().path()).collect();
    suites.retain(|path| path.join("plans/invalid").is_dir());
    suites.sort();
    suites
}

/// The names of the plans in a folder, without `.plan`.
fn plans(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let names = entries.map(|entry| entry.unwrap().path());
    names.map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect()
}

/// What stands below `[plan.NAME]`, key by key.
fn entries(expected: &str) -> BTreeMap<String, BTreeMap<String, String>> {
    let mut entries: BTreeMap<String, BTreeMap<String, String>> = BTreeMap::new();
    let mut current = None;
    for line in expected.lines() {
        if let Some(name) = line.strip_prefix('[') {
            let name = name.trim_end_matches(']').strip_prefix("plan.");
            current = name.map(|name| name.trim_matches('"').to_owned());
        } else if let (Some(name), Some((key, value))) = (&current, line.split_once(" = ")) {
            let value = value.trim_matches('"').to_owned();
            entries.entry(name.clone()).or_default().insert(key.to_owned(), value);
        }
    }
    entries
}

#[test]
fn every_invalid_plan_is_invalid_in_a_named_way() {
    let (mut unnamed, mut count, mut seen) = (Vec::new(), 0, BTreeSet::new());
    for suite in suites() {
        let entries = entries(&fs::read_to_string(suite.join("expected.toml")).unwrap_or_default());
        let valid = plans(&suite.join("plans/valid"));
        let mut why_of_all = BTreeSet::new();
        for plan in plans(&suite.join("plans/invalid")) {
            count += 1;
            let named = entries.get(&plan);
            let why = named.and_then(|named| named.get("why"));
            let detail = named.is_some_and(|named| {
                ["step", "line", "missing", "says"].iter().any(|key| named.contains_key(*key))
            });
            if why.is_none() || !detail {
                unnamed.push(format!("{}/{plan}: {named:?}", suite.display()));
            }
            why_of_all.extend(why.cloned());
        }
        // Where a task has no meaning no plan for it has one.
        if valid.is_empty() && !why_of_all.contains(Fault::IllFormed.word()) {
            unnamed.push(format!("{}: no valid plan", suite.display()));
        }
        seen.extend(why_of_all);
    }
    assert!(unnamed.is_empty(), "{}", unnamed.join("../.."));
    assert!(count >= 150, "only {count}");
    let without: Vec<&str> =
        Fault::ALL.iter().map(|fault| fault.word()).filter(|word| !seen.contains(*word)).collect();
    assert!(without.is_empty(), "no plan for {without:?}");
}

//! Campaigns on the Barthel test: small ones, which take seconds.
//!
//! `pelea campaign domains/barthel` plays every disruption at every instant (docs/campaign.md).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use cli::Exit;
use pelea_tests::{pelea, root};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;

fn folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("campaigns").join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn barthel() -> String {
    root().join("domains/barthel").to_string_lossy().into_owned()
}

#[test]
fn a_campaign_gives_the_same_results_again_and_goes_on_where_it_stopped() {
    let (first, second) = (folder("first"), folder("second"));
    let play = |folder: &PathBuf, more: &[&str]| {
        let (mission, out) = (barthel(), folder.to_string_lossy().into_owned());
        let mut arguments = vec![
            "campaign",
            &mission,
            "--every",
            "60",
            "--only",
            "lost-for-a-moment",
            "--only",
            "asks-for-help",
        ];
        arguments.extend(["--out", &out]);
        arguments.extend(more);
        let said = pelea(&arguments);
        assert_eq!(said.exit, Exit::Yes, "{}", said.err);
        said
    };
    let whole = play(&first, &[]);
    play(&second, &[]);
    let results = |folder: &PathBuf| fs::read_to_string(folder.join("results.jsonl")).unwrap();
    let runs = |text: &str| -> Vec<Value> {
        let all = text.lines().map(|line| serde_json::from_str::<Value>(line).unwrap());
        all.filter(|record| record["kind"] == "run").collect()
    };
    assert_eq!(runs(&results(&first)).len(), runs(&results(&second)).len());

    // A results file that was cut short.
    let text = results(&second);
    fs::write(second.join("results.jsonl"), &text[..text.len() * 2 / 3]).unwrap();
    let resumed = play(&second, &["--resume"]);
    assert_eq!(whole.out, resumed.out, "the table is the same");
    let ends = |folder: &PathBuf| {
        let mut ends: Vec<String> = runs(&results(folder))
            .iter()
            .map(|r| format!("{} {} {} {}", r["disruption"], r["instant"], r["outcome"], r["seconds"]))
            .collect();
        ends.sort();
        ends
    };
    assert_eq!(ends(&first), ends(&second));

    let old = first.join("results.jsonl").to_string_lossy().into_owned();
    let compared = play(&second, &["--resume", "--compare", &old]);
    assert!(compared.out.contains("0 end otherwise"), "{}", compared.out);
    let page = fs::read_to_string(first.join("index.html")).unwrap();
    assert!(page.contains("the person is out of view for three seconds"));
    assert!(!page.contains("http"), "the page needs nothing from elsewhere");
    assert!(fs::read_to_string(first.join("junit.xml")).unwrap().contains("failures=\"0\""));
}

/// Every disruption of the library, each at the beginning and in the middle of the test.
#[test]
fn whatever_is_disturbed_no_invariant_is_broken_and_every_end_has_a_name() {
    let mission = barthel();
    // A program without optimisations is ten times slower: it plays the beginning alone.
    let every = if cfg!(debug_assertions) { "400" } else { "200" };
    let said = pelea(&["campaign", &mission, "--every", every, "--seeds", "1..2", "--json"]);
    let records = said.records();
    let rows: Vec<_> = records.iter().filter(|record| record["kind"] == "disruption").collect();
    assert!(rows.len() > 100, "{} disruptions", rows.len());
    let bad = rows.iter().filter(|row| {
        let outcomes = row["outcomes"].as_object().unwrap();
        let named = ["accomplished", "with-human", "still-calling"];
        row["broken"] != 0 || outcomes.keys().any(|name| !named.contains(&name.as_str()))
    });
    let bad: Vec<_> = bad.map(ToString::to_string).collect();
    assert!(bad.is_empty(), "{}\n{}", bad.join("\n"), said.err);
    assert_eq!(said.exit, Exit::Yes, "{}", said.err);
}

//! A small campaign: two disruptions of the library at a few instants of the Barthel test.
//!
//! `pelea campaign domains/barthel` plays all of them.

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

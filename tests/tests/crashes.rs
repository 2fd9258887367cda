//! A run that is cut at some of its moments goes on; `cargo xtask crashes` cuts at all of them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use pelea_tests::crashes::{Cut, Original, folder};
use pelea_tests::root;
use std::path::Path;

/// Cuts a scenario at `points` of its commits, and within each of them.
fn survives(scenario: &str, points: usize) {
    let base = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let mission = root().join("domains/barthel");
    let original = Original::record(&mission, scenario, &folder(base, scenario)).unwrap();
    assert!(original.commits() > points);
    let at = folder(base, &format!("{scenario}-cut"));
    for point in 0..points {
        let commits = point * (original.commits() - 1) / points;
        for cut in [Cut::After(commits), Cut::Within(commits)] {
            let held = original.crash(cut, &at).unwrap();
            let wrong = original.goes_on(&held, &at);
            assert!(wrong.is_empty(), "{scenario}, {cut:?}, {held:?}: {wrong:#?}");
        }
        assert_eq!(original.replays(&at), Ok(()), "{scenario}, {commits} commits");
    }
}

#[test]
fn a_test_with_an_interruption_survives_a_crash() {
    survives("figure-8", 12);
}

#[test]
fn a_call_for_help_survives_a_crash() {
    survives("help", 12);
}

#[test]
fn a_call_about_silences_survives_a_crash() {
    survives("two-silences", 8);
}

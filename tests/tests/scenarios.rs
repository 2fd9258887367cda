//! Every scenario of every mission, in simulated time, held against its own expectations.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use cli::Exit;
use pelea_tests::{Said, missions, pelea, root};
use serde_json::Value;

fn play(mission: &str, scenario: &str, more: &[&str]) -> Said {
    let mut arguments = vec!["run", mission, "--scenario", scenario, "--speed", "max", "--json"];
    arguments.extend(more);
    pelea(&arguments)
}

fn barthel() -> String {
    root().join("domains/barthel").to_string_lossy().into_owned()
}

fn strings(value: &Value) -> Vec<&str> {
    value.as_array().unwrap().iter().map(|v| v.as_str().unwrap()).collect()
}

#[test]
fn every_scenario_meets_its_expectations() {
    let mut failures = Vec::new();
    let mut played = 0;
    for (mission, scenarios) in missions() {
        for scenario in scenarios {
            let said = play(&mission.to_string_lossy(), &scenario, &[]);
            let result = said.result();
            played += 1;
            for violation in strings(&result["violations"]) {
                failures.push(format!("{scenario}: {violation}"));
            }
            let accomplished = result["ending"] == "accomplished";
            if (said.exit == Exit::Yes) != (accomplished && strings(&result["violations"]).is_empty()) {
                failures.push(format!("{scenario}: exit {:?} does not say what came out", said.exit));
            }
        }
    }
    assert!(played >= 10, "only {played} scenarios were found");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_mission_passes_its_check_without_a_warning() {
    for (mission, _) in missions() {
        let said = pelea(&["check", &mission.to_string_lossy(), "--json"]);
        let result = said.result();
        assert_eq!((&result["errors"], &result["warnings"]), (&0.into(), &0.into()), "{}", said.out);
    }
}

#[test]
fn every_answer_that_was_given_is_in_the_report() {
    for (mission, scenarios) in missions() {
        for scenario in scenarios {
            let said = play(&mission.to_string_lossy(), &scenario, &[]);
            let records = said.records();
            let result = records.last().unwrap();
            let chosen = records
                .iter()
                .filter(|r| r["source"] == "graph")
                .flat_map(|r| strings(&r["now"]).into_iter().map(str::to_owned).collect::<Vec<_>>())
                .filter(|s| s.contains("was chosen in"))
                .count();
            let items = result["report"]["items"].as_array().unwrap();
            let answered = items.iter().filter(|i| i["status"] == "answered").count();
            assert_eq!(chosen, answered, "{scenario}: each answer once, and none lost");
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_bytes_and_another_seed_other_delays() {
    let (mission, first) = (barthel(), play(&barthel(), "figure-8", &["--seed", "7"]));
    assert_eq!(first.out, play(&mission, "figure-8", &["--seed", "7"]).out);
    assert_ne!(first.out, play(&mission, "figure-8", &["--seed", "8"]).out);
}

/// What a plan finds when it comes late is another world: the story changes, the outcome must not.
#[test]
fn breakage_16_decisions_that_take_their_time_change_no_ending() {
    for (mission, scenarios) in missions() {
        for scenario in scenarios {
            let mission = mission.to_string_lossy();
            let at_once = play(&mission, &scenario, &[]).result()["ending"].clone();
            let slow =
                play(&mission, &scenario, &["--planning-latency", "0.1..3"]).result()["ending"].clone();
            assert_eq!(slow, at_once, "{scenario}");
        }
    }
}

#[test]
fn speech_stops_in_the_very_version_in_which_the_person_is_lost() {
    let said = play(&barthel(), "figure-8", &[]);
    let records = said.records();
    let lost = records
        .iter()
        .find(|r| r["source"] == "graph" && strings(&r["no_longer"]).contains(&"person is with robot"))
        .unwrap();
    assert!(strings(&lost["no_longer"]).contains(&"robot is speaking"), "{lost}");
    assert!(strings(&lost["now"]).contains(&"robot is not speaking"), "{lost}");
    assert_eq!(lost["reflex"], true);
}

#[test]
fn a_replan_names_the_lost_person() {
    let said = play(&barthel(), "figure-8", &[]);
    let deviations: Vec<_> = said.records().into_iter().filter(|r| r["event"] == "deviated").collect();
    assert!(!deviations.is_empty());
    assert!(
        deviations.iter().any(|d| d["broken"][0]["fact"] == "(present person)"
            && d["broken"][0]["expected"] == true
            && d["broken"][0]["needed_by"]["action"] != Value::Null),
        "{deviations:?}"
    );
}

#[test]
fn the_test_is_given_in_each_language() {
    let mut openings = Vec::new();
    for language in ["en", "es", "fr"] {
        let said = play(&barthel(), "all-answered", &["--lang", language]);
        assert_eq!(said.exit, Exit::Yes, "{language}: {}", said.err);
        let records = said.records();
        let first = records.iter().find(|r| r["event"] == "robot_says").unwrap();
        openings.push(first["text"].as_str().unwrap().to_owned());
        assert_eq!(records.last().unwrap()["report"]["language"], language);
    }
    openings.dedup();
    assert_eq!(openings.len(), 3, "three languages say three things");
}

#[test]
fn the_text_form_tells_the_story() {
    let said = pelea(&["run", &barthel(), "--scenario", "figure-8", "--speed", "max"]);
    assert_eq!(said.exit, Exit::Yes, "{}", said.err);
    for line in ["robot is speaking", "person got answer", "replan", "because", "mission accomplished"] {
        assert!(said.out.contains(line), "`{line}` is missing in:\n{}", said.out);
    }
}

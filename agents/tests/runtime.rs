//! The pure runtime: what it commits, launches and stops, on a real graph and without devices.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use agents::{Action, Datum, Ended, Outcome, Runtime};
use common::{Bench, Lab, at};
use dsr::Isometry3;
use expect_test::expect;

fn well() -> Ended {
    Ended::well(Vec::new())
}

#[test]
fn before_during_and_after() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.end(2, "say", well());
    expect![[r#"
        v2 director: robot shall say hello
        v3 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
        v4 talker: no longer: robot is speaking, no longer: robot shall say hello, no longer: robot says hello, robot said hello
    "#]].assert_eq(&bench.log());
}

#[test]
fn the_reflex_writes_in_the_version_in_which_the_person_is_lost() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    bench.direct(2, &["-person is_with robot"]);
    // One commit, by the director; then the skill is dropped.
    expect![[r#"
        v4 director: no longer: robot is speaking, no longer: robot says hello, no longer: person is with robot, robot is not speaking
        talker: stop say person hello
    "#]].assert_eq(&bench.log());
    assert!(bench.running.is_empty());
}

#[test]
fn a_rule_starts_again_when_its_conditions_hold_again() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.direct(2, &["-person is_with robot"]);
    bench.log();
    bench.direct(3, &["+person is_with robot"]);
    expect![[r#"
        v5 director: person is with robot
        v6 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn an_ending_after_the_reflex_is_ignored() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    // The person is lost before the runtime hears that the skill has ended.
    bench.lab.direct(&["-person is_with robot"], 2);
    bench.end(2, "say", well());
    assert!(!bench.log().contains("said"));
}

#[test]
fn a_lease_is_taken_from_a_lower_priority_whose_reflex_has_its_say_first() {
    let mut bench = Bench::new(&["talker", "shouter"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    bench.direct(2, &["+robot shall_shout fire"]);
    expect![[r#"
        v4 director: robot shall shout fire
        v5 shouter: no longer: robot is speaking, no longer: robot says hello, robot is not speaking
        v6 shouter: no longer: robot is not speaking, robot is speaking, robot says fire
        shouter: launch say robot fire
        talker: stop say person hello
    "#]]
    .assert_eq(&bench.log());
    let running: Vec<_> = bench.running.values().map(|(_, call)| call.arguments.join(" ")).collect();
    assert_eq!(running, ["robot fire"]);
    // The lower priority waits, and has its turn afterwards.
    bench.end(5, "say", well());
    expect![[r#"
        v7 shouter: no longer: robot is speaking, no longer: robot shall shout fire, no longer: robot says fire, robot is not speaking, robot said fire
        v8 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
    "#]].assert_eq(&bench.log());
}

#[test]
fn a_lower_priority_waits_for_a_higher_one() {
    let mut bench = Bench::new(&["talker", "shouter"]);
    bench.direct(1, &["+robot shall_shout fire"]);
    bench.log();
    bench.direct(2, &["+robot shall_say hello"]);
    expect![[r#"
        v4 director: robot shall say hello
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn two_bindings_of_one_rule_take_turns_on_one_resource() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello", "+robot shall_say goodbye"]);
    assert_eq!(bench.running.len(), 1);
    bench.end(2, "say", well());
    bench.end(3, "say", well());
    let log = bench.log();
    assert!(log.contains("robot said hello") && log.contains("robot said goodbye"), "{log}");
    assert!(bench.running.is_empty());
}

#[test]
fn the_duration_is_over() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    bench.settle(10);
    assert_eq!(bench.log(), "");
    bench.settle(11);
    expect![[r#"
        talker: stop say person hello
        v4 talker: no longer: robot is speaking, no longer: robot says hello, robot is broken
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn an_outcome_without_effects_ends_like_an_abort_and_a_failure_rests() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    bench.end(2, "say", Ended::otherwise(Outcome::FAILURE));
    expect![[r#"
        v4 talker: no longer: robot is speaking, no longer: robot says hello, robot is not speaking
    "#]]
    .assert_eq(&bench.log());
    bench.settle(3);
    expect![[r#"
        v5 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn what_the_rule_begins_may_be_what_must_keep_holding() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_ask person"]);
    expect![[r#"
        v2 director: robot shall ask person
        v3 talker: no longer: robot shall ask person, robot waits for person
        talker: launch listen person
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn results_are_bound_at_the_end() {
    let mut bench = Bench::new(&["talker", "watcher"]);
    bench.direct(1, &["+robot shall_ask person"]);
    bench.log();
    bench.end(2, "listen", Ended::well(vec![Datum::Node("goodbye".into())]));
    expect![[r#"
        v4 talker: no longer: robot waits for person, robot heard goodbye
    "#]]
    .assert_eq(&bench.log());

    bench.direct(3, &["-person is_with robot"]);
    bench.log();
    bench.end(4, "await-person", Ended::well(vec![Datum::Pose(Isometry3::translation(1.0, 2.0, 0.0))]));
    expect![[r#"
        v6 watcher: person at (1.000, 2.000, 0.000) in world, person is with robot
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn another_outcome_has_its_own_effects() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_ask person"]);
    bench.log();
    bench.end(2, "listen", Ended::otherwise("misheard"));
    expect![[r#"
        v4 talker: no longer: robot waits for person, robot missed person
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn a_result_that_is_no_node_ends_like_an_abort() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_ask person"]);
    bench.log();
    bench.end(2, "listen", Ended::well(vec![Datum::Node("nothing-of-the-kind".into())]));
    expect![[r#"
        v4 talker: no longer: robot waits for person
    "#]]
    .assert_eq(&bench.log());
    bench.direct(10, &["+robot shall_ask person"]);
    bench.log();
    // A node, but of a type that the token does not take.
    bench.end(12, "listen", Ended::well(vec![Datum::Node(Arc::from("robot"))]));
    expect![[r#"
        v7 talker: no longer: robot waits for person
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn a_rule_without_a_skill_is_over_when_it_begins() {
    let mut bench = Bench::new(&["talker", "secretary"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    bench.end(2, "say", well());
    expect![[r#"
        v4 talker: no longer: robot is speaking, no longer: robot shall say hello, no longer: robot says hello, robot said hello
        v5 secretary: no longer: robot said hello, robot heard hello
    "#]].assert_eq(&bench.log());
}

#[test]
fn who_missed_commits_stops_what_no_longer_holds() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello", "+robot shall_ask person"]);
    bench.log();
    bench.miss(2, &["-person is_with robot"]);
    expect![[r#"
        v5 director: no longer: robot is speaking, no longer: robot says hello, no longer: person is with robot, robot is not speaking
        talker: stop say person hello
    "#]].assert_eq(&bench.log());
}

#[test]
fn an_agent_that_was_declared_dead_and_is_not_starts_again() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.log();
    let talker = bench.lab.graph.vocabulary().agent("talker").unwrap();
    bench.lab.graph.expire(talker, at(2)).unwrap();
    bench.settle(2);
    expect![[r#"
        v4 dsr: no longer: robot is speaking, no longer: robot says hello, robot is not speaking
        talker: stop say person hello
        v5 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn an_agent_is_woken_for_the_patterns_of_its_rules_only() {
    let lab = Lab::new();
    let mut subscription = lab.graph.subscribe_to(lab.agent("talker").interest());
    assert!(subscription.try_recv().unwrap().deltas.is_empty());
    let woken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&woken);
    subscription.on_wake(move || _ = count.fetch_add(1, Ordering::SeqCst));
    // A token of its rules, with another node at its end; then one of no rule.
    lab.direct(&["+robot is quiet"], 1);
    lab.direct(&["+robot shall_shout fire"], 2);
    assert_eq!(woken.load(Ordering::SeqCst), 0);
    lab.direct(&["+robot shall_say hello"], 3);
    assert_eq!(woken.load(Ordering::SeqCst), 1);
    let news = subscription.try_recv().unwrap();
    assert_eq!(news.matches.iter().map(|changed| changed.appeared.len()).collect::<Vec<_>>(), [1]);
}

#[test]
fn a_rule_that_would_break_its_own_condition_starts_when_it_no_longer_would() {
    let mut bench = Bench::new(&["polite"]);
    bench.direct(1, &["+robot is quiet"]);
    bench.direct(2, &["+robot shall_ask person"]);
    bench.direct(3, &["-robot is quiet"]);
    expect![[r#"
        v2 director: robot is quiet
        v3 director: robot shall ask person
        v4 director: no longer: robot is quiet
        v5 polite: robot waits for person
        polite: launch say person person
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn the_same_script_gives_the_same_log() {
    let script = || {
        let mut bench = Bench::new(&["talker", "shouter", "watcher"]);
        bench.direct(1, &["+robot shall_say hello", "+robot shall_say goodbye", "+robot shall_ask person"]);
        bench.direct(2, &["+robot shall_shout fire"]);
        bench.direct(3, &["-person is_with robot"]);
        bench.settle(20);
        bench.log()
    };
    assert_eq!(script(), script());
}

#[test]
fn an_edge_that_is_written_through_its_attribute_may_break_a_condition() {
    let mut bench = Bench::new(&["host"]);
    bench.direct(1, &["+robot is quiet"]);
    bench.direct(2, &["+robot shall_ask person"]);
    assert!(bench.running.is_empty());
    bench.direct(3, &["-robot is quiet"]);
    assert_eq!(bench.running.len(), 1, "{}", bench.log());
}

#[test]
fn a_runtime_whose_life_is_over_stops_its_skills_and_writes_nothing() {
    let lab = Lab::new();
    let agent = lab.agent("talker");
    let life = lab.graph.attend(agent.id);
    let mut subscription = lab.graph.subscribe_to(agent.interest());
    let mut runtime = Runtime::new(agent).in_epoch(life.epoch());
    lab.direct(&["+robot shall_say hello", "+robot shall_ask person"], 1);
    let mut settle = |news: bool| {
        while let Some(news) = subscription.try_recv().filter(|_| news) {
            runtime.changed(&news);
        }
        let (mut launched, mut stopped) = (0, 0);
        while let Some(action) = runtime.next_action(&lab.graph.snapshot(), at(1)) {
            match action {
                Action::Commit(transaction) => {
                    runtime.committed(lab.graph.commit(&transaction, at(1)).as_ref(), at(1));
                }
                Action::Launch { instance, .. } => {
                    launched += 1;
                    if launched == 2 {
                        // Its ending will be the first commit that is refused.
                        runtime.ended(instance, well());
                        drop(lab.graph.attend(runtime.agent().id));
                    }
                }
                Action::Stop(_) => stopped += 1,
            }
        }
        (launched, stopped, runtime.is_fenced(), runtime.running())
    };
    assert_eq!(settle(true), (2, 2, true, 0));
    let version = lab.graph.snapshot().version();
    lab.direct(&["+robot shall_say goodbye"], 2);
    assert_eq!(settle(true), (0, 0, true, 0));
    assert_eq!(lab.graph.snapshot().version().0, version.0 + 1);
}

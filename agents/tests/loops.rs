//! No loop without time passing: rules that undo each other's conditions rest, whatever ends them.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use agents::{Ended, Outcome};
use common::{Bench, at};
use expect_test::expect;

#[test]
fn a_rule_that_preempts_what_triggers_it_rests() {
    let mut bench = Bench::new(&["talker", "heckler"]);
    bench.direct(1, &["+robot shall_say hello"]);
    // The heckler gives the mouth back, because nobody speaks once it has it; then it is the one that rests.
    expect![[r#"
        v2 director: robot shall say hello
        v3 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
        v4 heckler: no longer: robot is speaking, no longer: robot says hello, robot is not speaking
        v5 heckler: 
        talker: stop say person hello
        v6 talker: no longer: robot is not speaking, robot is speaking, robot says hello
        talker: launch say person hello
    "#]]
    .assert_eq(&bench.log());
}

#[test]
fn a_rule_is_interrupted_ever_more_rarely_by_one_that_achieves_nothing() {
    let mut bench = Bench::new(&["talker", "heckler"]);
    bench.direct(1, &["+robot shall_say hello"]);
    let mut interrupted = Vec::new();
    for second in 2..20 {
        bench.settle(second);
        if bench.log().contains("says hello") {
            interrupted.push(second);
        }
    }
    assert_eq!(interrupted, [2, 4, 8, 16]);
}

#[test]
fn two_agents_that_undo_each_other_without_skills_rest() {
    let mut bench = Bench::new(&["talker", "clerk", "auditor"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.end(2, "say", Ended::well(Vec::new()));
    bench.log();
    let mut starts = Vec::new();
    for second in 3..80 {
        bench.settle(second);
        starts.extend(bench.log().lines().map(|_| second));
    }
    // Alternately 1, 2, 4 … 30 s apart.
    assert!(starts.len() < 20, "{starts:?}");
}

#[test]
fn failures_in_a_row_rest_twice_as_long_each_time_until_a_success() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    let mut starts = vec![1];
    for second in 2..130 {
        if bench.running.is_empty() {
            bench.settle(second - 1);
        }
        bench.settle(second);
        if !bench.running.is_empty() {
            starts.push(second);
            bench.end(second, "say", Ended::otherwise(Outcome::FAILURE));
        }
    }
    assert_eq!(starts, [1, 2, 3, 5, 9, 17, 33, 63, 93, 123]);
}

#[test]
fn a_success_that_took_time_forgets_the_failures() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    bench.end(1, "say", Ended::otherwise(Outcome::FAILURE));
    bench.settle(2);
    bench.end(2, "say", Ended::otherwise(Outcome::FAILURE));
    bench.settle(3);
    assert!(bench.running.is_empty());
    bench.settle(4);
    bench.end(5, "say", Ended::well(Vec::new()));
    bench.direct(6, &["+robot shall_say hello"]);
    bench.end(6, "say", Ended::otherwise(Outcome::FAILURE));
    bench.settle(7);
    assert_eq!(bench.running.len(), 1);
}

#[test]
fn a_rest_can_be_seen() {
    let mut bench = Bench::new(&["talker"]);
    bench.direct(1, &["+robot shall_say hello"]);
    assert!(bench.resting().is_empty());
    bench.end(1, "say", Ended::otherwise(Outcome::FAILURE));
    let [rest] = bench.resting().try_into().unwrap();
    assert_eq!((&*rest.rule, rest.until, rest.in_a_row), ("say", at(2), 1));
    let names: Vec<_> = rest.parameters.iter().map(|&node| bench.lab.name(node)).collect();
    assert_eq!(names, ["robot", "person", "hello"]);
    bench.settle(2);
    assert!(bench.resting().is_empty());
}

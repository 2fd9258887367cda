//! Durative actions that have nothing to do with each other run together.

use crate::bench::{Bench, on_a};
use executive::{Ending, Narration, Policy};

/// Each lamp is served by light, or by a call where it is dead; to light one takes two hands at its start.
const DOMAIN: &str =
    "(define (domain lamps) (:requirements :typing :negative-preconditions :durative-actions)
  (:types lamp) (:predicates (served ?l - lamp) (dead ?l - lamp) (wanted ?l - lamp))
  (:durative-action light-first :parameters (?l - lamp)
    :duration (and (>= ?duration 1) (<= ?duration 4))
    :condition (and (over all (not (dead ?l))) (at start (not (wanted ?l))))
    :effect (and (at start (wanted ?l)) (at end (not (wanted ?l))) (at end (served ?l))))
  (:durative-action call :parameters (?l - lamp) :duration (<= ?duration 100)
    :condition (over all (dead ?l)) :effect (at end (served ?l))))";
const PROBLEM: &str = "(define (problem both) (:domain lamps) (:objects a b - lamp)
  (:goal (and (served a) (served b))))";
const PERCEPTION: &str = "(define (domain lamps-perception)
  (:requirements :typing :disjunctive-preconditions :derived-predicates) (:import lab lamps)
  (:derived (served ?l - lamp) (or (is ?l lit) (is ?l attended)))
  (:derived (wanted ?l - lamp) (is ?l wanted))
  (:derived (dead ?l - lamp) (is ?l broken)))";

fn bench() -> Bench {
    let policy = Policy { attempts: 2, ..Policy::new(on_a("give-up")) };
    Bench::planning(policy, [DOMAIN, PROBLEM, PERCEPTION])
}

#[test]
fn both_run_at_once_and_either_may_be_done_first() {
    for first in ["a", "b"] {
        let mut bench = bench();
        bench.plan();
        assert!(bench.wants("a") && bench.wants("b"), "{}", bench.story());
        let second = if first == "a" { "b" } else { "a" };
        bench.write("lighter", first, "lit");
        assert!(bench.wants(second), "{}", bench.story());
        assert!(bench.requests.is_empty(), "{}", bench.story());
        bench.write("lighter", second, "lit");
        assert_eq!(bench.ending, Some(Ending::Accomplished), "{}", bench.story());
        assert_eq!(bench.count(|n| matches!(n, Narration::Achieved { .. })), 2);
        assert_eq!(bench.count(|n| matches!(n, Narration::Skipped { .. })), 0);
    }
}

#[test]
fn an_action_that_runs_survives_a_plan_that_has_it_too() {
    let mut bench = bench();
    bench.plan();
    bench.write("lighter", "b", "broken");
    assert!(bench.wants("a"), "it goes on while a plan is made");
    bench.plan();
    let planned = bench.told.iter().rev().find(|n| matches!(n, Narration::Planned { .. }));
    assert!(matches!(planned, Some(Narration::Planned { survives: true, .. })), "{}", bench.story());
    assert!(bench.wants("a") && !bench.wants("b") && bench.is("b", "ringing"), "{}", bench.story());
    let starts = |lamp: &str| {
        let named = format!("(light-first {lamp})");
        bench.count(|n| matches!(n, Narration::Started { step, .. } if step.to_string() == named))
    };
    assert_eq!((starts("a"), starts("b")), (1, 1), "it is not started again");
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "attended");
    assert_eq!(bench.ending, Some(Ending::Accomplished), "{}", bench.story());
}

#[test]
fn an_action_that_is_not_done_at_its_deadline_has_failed_and_the_other_goes_on() {
    let mut bench = bench();
    bench.plan();
    bench.pass(3.9);
    assert!(bench.requests.is_empty(), "{}", bench.story());
    bench.write("lighter", "a", "lit");
    bench.pass(0.2);
    let late = bench.count(|n| matches!(n, Narration::Failed { why: executive::StepFailure::Late(4.0), .. }));
    assert_eq!(late, 1, "{}", bench.story());
    assert!(!bench.wants("b"));
}

#[test]
fn an_action_that_breaks_off_does_not_stop_the_other() {
    let mut bench = bench();
    bench.plan();
    // Somebody takes the intention away: the start of the action is undone, and its rest cannot be done either.
    bench.write("lighter", "a", "broken");
    bench.plan();
    assert!(bench.wants("b") && bench.is("a", "ringing"), "{}", bench.story());
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, None);
    bench.write("lighter", "a", "attended");
    assert_eq!(bench.ending, Some(Ending::Accomplished), "{}", bench.story());
}

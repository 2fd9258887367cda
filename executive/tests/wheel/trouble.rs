//! No plan: the fallback, and the ways out of it.

use crate::bench::{Bench, later, on_a};
use dsr::Time;
use executive::{Decision, Ending, Event, Narration, NoPlan, Policy};

/// A bench whose fallback rings until it is attended, and whose plans are made at once.
fn ringing() -> Bench {
    let mut bench = Bench::with_fallback("call");
    bench.at_once = true;
    bench.plan();
    bench
}

#[test]
fn breakage_6_a_step_that_failed_is_tried_again_in_the_same_state() {
    let mut bench = Bench::new();
    bench.plan();
    bench.pass(5.5);
    assert_eq!(bench.count(|n| matches!(n, Narration::Failed { .. })), 1);
    assert!(!bench.wants("a"));
    bench.plan();
    assert_eq!(bench.count(|n| matches!(n, Narration::Resting { .. })), 1);
    assert_eq!(bench.ending, None);
    bench.pass(2.0);
    bench.plan();
    assert!(bench.wants("a"), "{:?}", bench.told);
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
}

#[test]
fn a_step_that_fails_as_often_as_the_mission_allows_starts_the_fallback() {
    let mut bench = ringing();
    bench.pass(5.0 + 2.0 + 4.9);
    assert!(bench.wants("a") && !bench.is("a", "ringing"));
    bench.pass(0.2);
    assert!(bench.is("a", "ringing"), "{:?}", bench.told);
    bench.write("lighter", "a", "attended");
    assert!(matches!(bench.ending, Some(Ending::WithHuman { .. })), "{:?}", bench.ending);
}

#[test]
fn breakage_6_a_plan_displaces_the_fallback() {
    let mut bench = ringing();
    bench.write("lighter", "b", "broken");
    assert!(bench.is("a", "ringing") && !bench.wants("a"));
    bench.pass(400.0);
    bench.take("lighter", "b", "broken");
    assert!(bench.wants("a"), "{:?}", bench.told);
    assert!(!bench.is("a", "ringing"), "the call is withdrawn");
    assert_eq!(bench.count(|n| matches!(n, Narration::Displaced { .. })), 1);
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
}

#[test]
fn breakage_5_a_call_that_nobody_hears_is_repeated_and_no_failure_ends_the_mission() {
    let mut bench = ringing();
    bench.write("lighter", "b", "broken");
    bench.pass(3_600.0);
    assert_eq!(bench.ending, None);
    let waits: Vec<f64> = bench
        .told
        .iter()
        .filter_map(|n| if let Narration::Retried { seconds, .. } = n { Some(*seconds) } else { None })
        .collect();
    assert_eq!(waits[..7], [2.0, 4.0, 8.0, 16.0, 32.0, 60.0, 60.0]);
    // In a wait or not: the call stands again within the longest wait.
    bench.pass(60.0);
    assert!(bench.is("a", "ringing"));
    bench.write("lighter", "a", "attended");
    assert!(matches!(bench.ending, Some(Ending::WithHuman { why: NoPlan::Unsolvable(_) })));
}

#[test]
fn breakage_5_at_the_horizon_the_mission_is_still_calling() {
    let policy = Policy::new(on_a("call"));
    let mut bench = Bench::of(policy, |wheel| wheel.until(later(Time(0), 7_300.0)));
    bench.at_once = true;
    bench.plan();
    bench.write("lighter", "b", "broken");
    bench.pass(7_299.0);
    assert_eq!(bench.ending, None);
    bench.pass(1.0);
    assert!(matches!(bench.ending, Some(Ending::StillCalling { .. })), "{:?}", bench.ending);
    assert!(bench.is("a", "ringing"), "an unattended call stands");
}

#[test]
fn at_the_horizon_a_mission_may_be_still_going() {
    let mut bench = Bench::of(Policy::new(on_a("call")), |wheel| wheel.until(later(Time(0), 3.0)));
    bench.plan();
    bench.pass(3.0);
    assert_eq!(bench.ending, Some(Ending::StillGoing));
}

#[test]
fn that_there_was_no_plan_is_not_believed_of_a_state_that_has_moved_on() {
    let mut bench = Bench::with_fallback("call");
    let request = bench.requests.pop_front().unwrap();
    bench.write("lighter", "b", "broken");
    bench.turn(Event::Decided(request.id, bench.nothing_helps()));
    assert!(!bench.is("a", "ringing"), "{:?}", bench.told);
    assert_eq!(bench.requests.len(), 1);
}

#[test]
fn a_planner_that_stops_is_followed_by_the_fallback() {
    let mut bench = Bench::with_fallback("light-first");
    let request = bench.requests.pop_front().unwrap();
    bench.turn(Event::Decided(request.id, Decision::NoPlan(NoPlan::Stopped)));
    assert!(bench.wants("a"));
    bench.write("lighter", "a", "lit");
    // The state has changed since there was no plan: one more question, and this time there is an answer.
    bench.plan();
    assert_eq!(bench.ending, None);
    assert!(bench.wants("b"));
}

#[test]
fn a_fallback_that_the_graph_refuses_is_tried_again() {
    let mut bench = Bench::with_fallback("call");
    let request = bench.requests.pop_front().unwrap();
    let none = bench.nothing_helps();
    bench.refuses = true;
    bench.turn(Event::Decided(request.id, none));
    assert!(!bench.is("a", "ringing"));
    bench.pass(183.0);
    assert!(bench.is("a", "ringing"), "{:?}", bench.told);
    assert_eq!(bench.ending, None);
}

#[test]
fn a_fallback_that_does_not_exist_ends_nothing() {
    let mut bench = Bench::with_fallback("dance");
    bench.at_once = true;
    bench.plan();
    bench.write("lighter", "b", "broken");
    bench.pass(600.0);
    assert_eq!(bench.ending, None);
    bench.take("lighter", "b", "broken");
    assert!(bench.wants("a"));
}

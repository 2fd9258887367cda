//! Decisions that take their time.

use crate::bench::{Bench, on_a};
use executive::{Effect, Event, Narration, NoPlan, Policy};
use std::time::Duration;

fn policy() -> Policy {
    Policy { deciding: Duration::from_secs(10), ..Policy::new(on_a("call")) }
}

#[test]
fn breakage_16_a_decision_that_takes_too_long_starts_the_fallback_and_a_plan_displaces_it() {
    let mut bench = Bench::with_policy(policy());
    bench.pass(9.9);
    assert!(!bench.is("a", "ringing"));
    bench.pass(0.1);
    assert!(bench.is("a", "ringing"));
    assert_eq!(bench.count(|n| matches!(n, Narration::FellBack { why: NoPlan::Late(10.0) })), 1);
    bench.plan();
    assert!(bench.wants("a") && !bench.is("a", "ringing"));
}

#[test]
fn a_late_decision_for_a_world_that_has_moved_on_is_cancelled() {
    let mut bench = Bench::with_policy(policy());
    bench.pass(11.0);
    let first = bench.requests[0].id;
    bench.write("lighter", "b", "broken");
    assert_eq!(bench.requests.len(), 1);
    assert!(bench.requests[0].id > first, "asked anew, for the present state");
    bench.plan();
    assert!(bench.is("a", "ringing"));
}

#[test]
fn a_task_of_the_mission_bridges_the_time_of_a_decision() {
    let meanwhile = Some(on_a("one-moment"));
    let mut bench = Bench::with_policy(Policy { meanwhile, ..policy() });
    bench.pass(0.9);
    assert!(!bench.is("a", "hushed"));
    bench.pass(0.1);
    assert!(bench.is("a", "hushed"));
    bench.plan();
    assert!(bench.wants("a"));
}

#[test]
fn a_plan_that_fits_again_needs_no_decision() {
    let mut bench = Bench::with_policy(policy());
    bench.plan();
    bench.write("lighter", "b", "broken");
    assert_eq!(bench.requests.len(), 1);
    bench.take("lighter", "b", "broken");
    assert!(bench.requests.is_empty(), "the question is cancelled");
    assert_eq!(bench.count(|n| matches!(n, Narration::FitsAgain)), 1);
    bench.write("lighter", "a", "lit");
    assert!(bench.wants("b"), "and the plan goes on");
}

#[test]
fn the_current_step_keeps_its_intention_while_a_plan_is_made() {
    let mut bench = Bench::with_policy(policy());
    bench.plan();
    bench.write("lighter", "b", "broken");
    bench.pass(3.0);
    assert!(bench.wants("a"));
}

#[test]
fn a_question_is_cancelled_when_the_mission_ends() {
    let mut bench = Bench::with_policy(policy());
    bench.write("lighter", "a", "lit");
    assert_eq!(bench.requests.len(), 1);
    bench.write("lighter", "b", "lit");
    assert!(bench.requests.is_empty());
    assert!(bench.wheel.step(Event::Woke, bench.now).iter().all(|e| !matches!(e, Effect::Plan(_))));
}

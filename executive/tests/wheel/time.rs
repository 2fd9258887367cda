//! Deadlines, and a process that does not run all the time.

use crate::bench::{Bench, on_a};
use executive::{Ending, Event, Narration, Policy};
use std::time::Duration;

fn real() -> Bench {
    let mut bench = Bench::of(Policy::new(on_a("call")), |wheel| wheel.with_pulse(Duration::from_secs(1)));
    bench.plan();
    bench
}

fn failures(bench: &Bench) -> usize {
    bench.count(|n| matches!(n, Narration::Failed { .. }))
}

#[test]
fn breakage_8_a_process_that_was_stopped_condemns_nobody() {
    for (before, stop) in [(0.5, 9.0), (3.5, 1.4), (4.9, 9.0), (2.0, 100_000.0)] {
        let mut bench = real();
        bench.pass(before);
        bench.stand_still(stop);
        // The timer rings, long after the deadline of five seconds; the report of the lamp is still on its way.
        bench.turn(Event::Woke);
        assert_eq!(failures(&bench), 0, "stopped {stop} s after {before} s: {:?}", bench.told);
        bench.pass(0.05);
        bench.write("lighter", "a", "lit");
        bench.write("lighter", "b", "lit");
        assert_eq!(bench.ending, Some(Ending::Accomplished));
        assert_eq!(bench.count(|n| matches!(n, Narration::StoodStill { .. })), 1);
    }
}

#[test]
fn after_a_stop_a_deadline_still_passes() {
    let mut bench = real();
    bench.pass(0.5);
    bench.stand_still(9.0);
    bench.pass(5.1);
    assert_eq!(failures(&bench), 1);
}

/// The lamp is lit in time, and the wheel gets to read its queue only after the deadline.
#[test]
fn breakage_8_a_version_is_judged_by_the_time_of_its_own_commit() {
    let mut bench = real();
    bench.pass(4.9);
    let is = bench.graph.vocabulary().label("is").unwrap();
    let (beside, other) = (bench.graph.vocabulary().label("is").unwrap(), "attended");
    // Two versions before the deadline; the first has nothing to do with it.
    bench.commit("lighter", vec![dsr::Edit::AddEdge { from: "b".into(), label: beside, to: other.into() }]);
    bench.commit("lighter", vec![dsr::Edit::AddEdge { from: "a".into(), label: is, to: "lit".into() }]);
    let queue = bench.seen();
    assert_eq!(queue.len(), 2);
    bench.stand_still(0.2);
    for event in queue {
        bench.turn(event);
    }
    assert_eq!(failures(&bench), 0, "{:?}", bench.told);
    assert!(bench.wants("b"));
}

#[test]
fn a_deadline_passes_after_its_own_instant() {
    let mut bench = real();
    bench.pass(5.0);
    assert_eq!(failures(&bench), 0);
    bench.write("lighter", "a", "lit");
    assert_eq!(failures(&bench), 0);
    assert!(bench.wants("b"));
}

/// The time of a pause is nobody's failure: an intention whose deadline passes is begun again.
#[test]
fn breakage_6_a_deadline_is_not_fatal() {
    let mut bench = Bench::with_policy(Policy::new(on_a("call")));
    bench.at_once = true;
    bench.plan();
    bench.pass(6.0);
    assert_eq!(failures(&bench), 1);
    bench.pass(3.0);
    assert!(bench.wants("a"));
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
}

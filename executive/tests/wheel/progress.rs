//! A mission that does not get on, although there are plans.

use crate::bench::{Bench, on_a};
use executive::{Bounds, Ending, Event, Narration, Policy, Stuck};

fn policy() -> Policy {
    Policy { bounds: Bounds { replans: 20, restarts: 10, asks: 20 }, ..Policy::new(on_a("call")) }
}

/// Lamp `b` is broken for half a second every ten seconds.
fn flicker(bench: &mut Bench, times: u32) {
    for _ in 0..times {
        bench.write("lighter", "b", "broken");
        bench.pass(0.5);
        bench.take("lighter", "b", "broken");
        bench.pass(9.5);
    }
}

fn escalations(bench: &Bench) -> Vec<Stuck> {
    let escalated = |n: &Narration| match n {
        Narration::Escalated { why, .. } => Some(why.clone()),
        _ => None,
    };
    bench.told.iter().filter_map(escalated).collect()
}

/// Each flicker takes the plan away, starts the fallback, and gives the plan back.
#[test]
fn breakage_10_a_flicker_is_escalated_and_does_not_replan_for_ever() {
    let mut bench = Bench::with_policy(policy());
    bench.at_once = true;
    bench.plan();
    // The lamp takes longer than ten seconds to be lit, so no step is ever done.
    flicker(&mut bench, 1_000);
    assert!(!escalations(&bench).is_empty());
    let plans = bench.count(|n| matches!(n, Narration::Planned { .. }));
    assert!(plans < 50, "{plans} plans");
    assert!(bench.is("a", "ringing"), "and somebody is called");
    assert_eq!(bench.ending, None);
}

#[test]
fn breakage_10_the_same_with_a_planner_that_is_slower_than_the_flicker() {
    let mut bench = Bench::with_policy(policy());
    bench.plan();
    for _ in 0..1_000 {
        bench.write("lighter", "b", "broken");
        bench.pass(0.5);
        bench.take("lighter", "b", "broken");
        bench.pass(0.5);
        while !bench.requests.is_empty() {
            bench.plan();
        }
        bench.pass(9.0);
    }
    assert!(!escalations(&bench).is_empty(), "{:?}", bench.told);
    let again = bench.count(|n| matches!(n, Narration::FitsAgain | Narration::Planned { .. }));
    assert!(again < 100, "{again}");
}

#[test]
fn after_an_escalation_the_mission_goes_on_with_more_patience_when_the_world_is_calm() {
    let mut bench = Bench::with_policy(policy());
    bench.at_once = true;
    bench.plan();
    flicker(&mut bench, 100);
    assert!(bench.is("a", "ringing"));
    bench.pass(22.0);
    assert!(bench.wants("a") && !bench.is("a", "ringing"), "{}", bench.story());
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
}

#[test]
fn an_escalation_that_is_carried_out_lets_the_mission_try_again() {
    let escalation = Some(on_a("call"));
    let mut bench = Bench::with_policy(Policy { escalation, attempts: 2, ..Policy::new(on_a("give-up")) });
    bench.at_once = true;
    bench.plan();
    bench.pass(5.0 + 2.0 + 5.1);
    assert!(bench.is("a", "ringing"), "{:?}", bench.told);
    assert!(matches!(escalations(&bench)[..], [Stuck::Attempts(_)]));
    bench.write("lighter", "a", "attended");
    assert!(bench.wants("a"), "{:?}", bench.told);
}

#[test]
fn progress_restores_patience() {
    let mut bench = Bench::with_policy(policy());
    bench.at_once = true;
    bench.plan();
    flicker(&mut bench, 9);
    bench.write("lighter", "a", "lit");
    flicker(&mut bench, 9);
    assert!(escalations(&bench).is_empty(), "{:?}", escalations(&bench));
}

#[test]
fn breakage_16_a_world_that_flips_before_each_plan_returns_is_escalated() {
    let mut bench = Bench::with_policy(policy());
    let mut requests = 0;
    for i in 0..1_000 {
        if i % 2 == 0 {
            bench.write("lighter", "b", "broken");
        } else {
            bench.take("lighter", "b", "broken");
        }
        // The answer is for the state before: that there is none, each time.
        if let Some(request) = bench.requests.pop_front() {
            requests += 1;
            let none = bench.nothing_helps();
            bench.turn(Event::Decided(request.id, none));
        }
        bench.pass(0.01);
    }
    assert!(requests < 100, "{requests} requests");
    assert!(matches!(escalations(&bench)[..], [Stuck::Asks(20)]), "{:?}", escalations(&bench));
    assert_eq!(bench.count(|n| matches!(n, Narration::AskedAgain { .. })), 20);
    assert!(bench.is("a", "ringing"));
}

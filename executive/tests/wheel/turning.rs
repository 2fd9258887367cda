//! A plan that is carried out.

use crate::bench::{Bench, refusal};
use dsr::Edit;
use executive::{Decision, Ending, Event, Narration};

#[test]
fn a_plan_is_carried_out_step_by_step_as_it_is_sensed() {
    let mut bench = Bench::new();
    bench.plan();
    assert!(bench.wants("a") && !bench.wants("b"));
    bench.write("lighter", "a", "lit");
    assert!(bench.wants("b"));
    assert_eq!(bench.ending, None);
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(bench.requests.is_empty());
}

#[test]
fn luck_skips_steps_and_takes_back_what_is_no_longer_wanted() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, None);
    bench.write("lighter", "a", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(bench.requests.is_empty(), "no planner was needed");
    assert!(!bench.wants("b"), "the second step never started");
}

#[test]
fn a_deviation_names_the_fact_and_who_needed_it() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "b", "broken");
    let Some(Narration::Deviated(deviation)) =
        bench.told.iter().find(|n| matches!(n, Narration::Deviated(_))).cloned()
    else {
        panic!("no deviation: {:?}", bench.told)
    };
    assert_eq!(deviation.broken.len(), 1);
    let literal = &deviation.broken[0];
    assert_eq!(literal.fact.as_ref().unwrap().to_string(), "(dead b)");
    assert!(!literal.expected);
    assert_eq!(literal.needed_by.as_ref().unwrap().to_string(), "(light a b)");
    assert_eq!(literal.given_by, None);

    bench.plan();
    assert!(matches!(bench.ending, Some(Ending::WithHuman { .. })), "{:?}", bench.ending);
    assert!(!bench.wants("a"), "what was intended is taken back");
}

#[test]
fn a_decision_for_a_state_that_has_moved_on_is_held_against_the_present() {
    let mut bench = Bench::new();
    let request = bench.requests.pop_front().unwrap();
    let decision = bench.decide(&request);
    assert!(matches!(decision, Decision::Plan { .. }));
    bench.write("lighter", "a", "lit");
    bench.turn(Event::Decided(request.id, decision));
    assert!(bench.wants("b") && !bench.wants("a"), "the first step is skipped");
    assert!(bench.requests.is_empty());
}

#[test]
fn an_answer_to_an_older_request_is_thrown_away() {
    let mut bench = Bench::new();
    let request = bench.requests.pop_front().unwrap();
    let decision = bench.decide(&request);
    bench.turn(Event::Decided(request.id, decision.clone()));
    let told = bench.told.len();
    bench.turn(Event::Decided(request.id, decision));
    assert_eq!(bench.told.len(), told);
}

#[test]
fn a_refused_write_is_a_failed_step() {
    let mut bench = Bench::new();
    bench.plan();
    bench.turn(Event::Refused(refusal()));
    assert_eq!(bench.count(|n| matches!(n, Narration::Refused { .. })), 1);
    assert_eq!(bench.count(|n| matches!(n, Narration::Failed { .. })), 1);
}

#[test]
fn a_goal_that_holds_before_there_is_a_plan_needs_none() {
    let mut bench = Bench::new();
    for lamp in ["a", "b"] {
        bench.write("lighter", lamp, "lit");
    }
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(!bench.wants("a"));
}

#[test]
fn a_deadline_that_passes_while_a_plan_is_made_stops_nothing() {
    let mut bench = Bench::new();
    bench.pass(9.0);
    bench.plan();
    assert!(bench.wants("a"), "{:?}", bench.told);
}

#[test]
fn missed_changes_are_made_up_for_by_one_look() {
    let mut bench = Bench::new();
    bench.plan();
    let is = bench.graph.vocabulary().label("is").unwrap();
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: is, to: "lit".into() }]);
    bench.seen();
    bench.turn(Event::Seen(bench.graph.snapshot()));
    assert!(bench.wants("b") && bench.requests.is_empty(), "{:?}", bench.told);
}

#[test]
fn commits_outside_the_interest_do_not_reach_the_wheel() {
    let mut bench = Bench::new();
    let vocabulary = bench.graph.vocabulary();
    let label = |name| vocabulary.label(name).unwrap();
    let (is, beside) = (label("is"), label("stands_beside"));
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: beside, to: "b".into() }]);
    assert!(bench.seen().is_empty());
    bench.commit("lighter", vec![Edit::AddEdge { from: "a".into(), label: is, to: "lit".into() }]);
    assert_eq!(bench.seen().len(), 1);
    // Its own commits do, whatever they change.
    bench.commit("pelea", vec![Edit::AddEdge { from: "b".into(), label: is, to: "wanted".into() }]);
    assert_eq!(bench.seen().len(), 1);
}

#[test]
fn the_same_events_give_the_same_story() {
    let run = || {
        let mut bench = Bench::new();
        bench.plan();
        bench.write("lighter", "a", "lit");
        bench.write("lighter", "b", "lit");
        serde_json::to_string(&bench.told).unwrap()
    };
    assert_eq!(run(), run());
}

/// What was committed in the last instant counts: a request for help that crosses the end is not lost.
#[test]
fn a_goal_that_is_undone_before_anybody_knew_of_the_end_is_pursued_further() {
    let mut bench = Bench::new();
    bench.plan();
    bench.write("lighter", "a", "lit");
    bench.write("lighter", "b", "lit");
    assert_eq!(bench.ending, Some(Ending::Accomplished));
    assert!(bench.requests.is_empty() && bench.wheel.has_ended());
    bench.take("lighter", "b", "lit");
    assert!(!bench.wheel.has_ended());
    assert_eq!(bench.requests.len(), 1);
}

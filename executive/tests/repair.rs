//! Decision Support on a plan that no longer fits.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use budget::Cancellation;
use executive::{Decision, GoalId, Model, Request, RequestId, Step};
use expect_test::{Expect, expect};
use low_to_high::Fact;
use pddl::model::Name;
use pddl::{Source, parse_domain, parse_problem};
use planner::{OperatorId, Way};
use std::sync::Arc;

const DOMAIN: &str = "(define (domain lamps) (:requirements :typing :negative-preconditions) (:types lamp)
    (:predicates (on ?l - lamp) (dead ?l - lamp) (open))
    (:action light :parameters (?l - lamp) :precondition (and (open) (not (dead ?l))) :effect (on ?l))
    (:action replace :parameters (?l - lamp) :precondition (dead ?l) :effect (not (dead ?l)))
    (:action unlock :parameters () :effect (open)))";
const PROBLEM: &str = "(define (problem p) (:domain lamps) (:objects a b c - lamp) (:init)
    (:goal (and (on a) (on b) (on c))))";

fn model() -> Arc<Model> {
    model_of(DOMAIN)
}

fn model_of(domain: &str) -> Arc<Model> {
    let domain = parse_domain(&Source::new("d", domain), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", PROBLEM), &domain).model.unwrap();
    Arc::new(Model::new(domain, problem, &["on", "dead", "open"].map(Name::new)).unwrap())
}

/// What Decision Support answers if nothing cancels it.
fn decide(model: &Arc<Model>, request: &Request) -> Decision {
    executive::decide(model, request, &Cancellation::default())
}

fn fact(text: &str) -> Fact {
    let mut words = text.split(' ').map(Name::new);
    Fact { predicate: words.next().unwrap(), arguments: words.collect() }
}

fn operator(model: &Model, name: &str) -> OperatorId {
    model.task().operators().ids().find(|&o| model.step(o).to_string() == name).unwrap()
}

fn request(model: &Model, seen: &[&str], broken: &[&str], running: Option<&str>) -> Request {
    let facts: Vec<Fact> = seen.iter().map(|text| fact(text)).collect();
    Request {
        id: RequestId(0),
        state: model.state(&facts),
        goals: vec![GoalId(0)],
        broken: broken.iter().map(|name| operator(model, name)).collect(),
        served: vec![GoalId(0)],
        running: running.map(|name| operator(model, name)).into_iter().collect(),
        barred: Vec::new(),
        expansions: 1_000,
        arrived: None,
    }
}

fn names(model: &Model, decision: &Decision) -> Vec<String> {
    let Decision::Plan { operators, .. } = decision else { panic!("{decision:?}") };
    operators.iter().map(|&o| model.step(o).to_string()).collect()
}

#[test]
fn the_rest_of_a_plan_is_kept() {
    let model = model();
    let request =
        request(&model, &["on b", "open", "dead a"], &["(light c)", "(light a)"], Some("(light c)"));
    let decision = decide(&model, &request);
    let plan = names(&model, &decision);
    assert_eq!(
        plan,
        ["(light c)", "(replace a)", "(light a)"],
        "what is running goes on, and one step is new"
    );
    let Decision::Plan { repair: Some(repair), .. } = &decision else { panic!("{decision:?}") };
    let reused = repair.reused.unwrap();
    assert_eq!((repair.by, reused.added, reused.removed), (Way::Reuse, 1, 0));
    assert_eq!(repair.scratch.unwrap().steps, 3);
    assert_eq!(format!("{decision:?}"), format!("{:?}", decide(&model, &request)), "the same each time");
}

#[test]
fn figures_are_those_of_the_plan_that_is_carried_out() {
    let model = model();
    let seen = &["on b", "open", "dead c"];
    let request = request(&model, seen, &["(light c)", "(light a)"], Some("(light a)"));
    let decision = decide(&model, &request);
    assert_eq!(names(&model, &decision), ["(light a)", "(replace c)", "(light c)"]);
    let Decision::Plan { repair: Some(repair), .. } = &decision else { panic!("{decision:?}") };
    let chosen = repair.chosen().unwrap();
    assert_eq!((chosen.added, chosen.removed, chosen.moved), (1, 0, 1));
}

#[test]
fn a_running_step_that_is_no_longer_possible_does_not_go_on() {
    let model = model();
    let request = request(&model, &["on b"], &["(light c)", "(light a)"], Some("(light c)"));
    assert_eq!(names(&model, &decide(&model, &request)), ["(unlock)", "(light c)", "(light a)"]);
}

#[test]
fn a_step_that_failed_is_not_reused() {
    let model = model();
    let mut request = request(&model, &["on b", "open"], &["(light c)", "(light a)"], None);
    request.barred = vec![Step { action: Name::new("light"), arguments: vec![Name::new("c")] }];
    assert!(matches!(decide(&model, &request), Decision::Barred(_)), "with it, there would be a plan");
}

#[test]
fn the_fallback_does_not_wait_long_for_the_reasons() {
    // Only a visit of all states, of which there are thousands, proves the task unsolvable.
    let fuses: Vec<String> = (0..10).map(|i| format!("(fuse{i})")).collect();
    let switches: String = (0..10)
        .map(|i| {
            format!("(:action in{i} :parameters () :effect (fuse{i})) (:action out{i} :parameters () :effect (not (fuse{i})))")
        })
        .collect();
    let domain = DOMAIN
        .replace("(:action unlock :parameters () :effect (open))", &switches)
        .replace("(dead ?l - lamp) (open)", &format!("(dead ?l - lamp) (open) {}", fuses.join(" ")))
        .replace("(and (open)", &format!("(and (open) {}", fuses.join(" ")))
        .replace(":effect (on ?l)", ":effect (and (on ?l) (not (open)))");
    let model = model_of(&domain);
    let mut request = request(&model, &["open"], &[], None);
    request.expansions = 100_000;
    let decision = decide(&model, &request);
    let Decision::NoPlan(why) = decision else { panic!("{decision:?}") };
    let why = why.to_string();
    assert!(why.contains("of the first 2000 states"), "{why}");
}

#[test]
fn a_first_plan_is_compared_with_none() {
    let model = model();
    let decision = decide(&model, &request(&model, &["open"], &[], None));
    assert!(matches!(&decision, Decision::Plan { repair: None, operators, .. } if operators.len() == 3));
}

#[test]
fn the_reasons_are_about_the_perceived_state() {
    let check = |domain: &str, seen: &[&str], barred: &[&str], expected: &Expect| {
        let model = model_of(domain);
        let mut request = request(&model, seen, &[], None);
        request.barred = barred.iter().map(|name| model.step(operator(&model, name))).collect();
        let decision = decide(&model, &request);
        let (Decision::NoPlan(why) | Decision::Barred(why)) = decision else { panic!("{decision:?}") };
        expected.assert_eq(&why.to_string());
    };
    // The problem itself has no lamp that is dead.
    let replace = "(:action replace :parameters (?l - lamp) :precondition (dead ?l) :effect (not (dead ?l)))";
    let dead = &["open", "dead a", "on b"];
    let expected = expect![
        "the goal needs (on a), which nothing can bring about: (on a) by (light a) needs (not (dead a)); nothing takes \
         (dead a) away"
    ];
    check(&DOMAIN.replace(replace, ""), dead, &[], &expected);
    let expected = expect![
        "the goal needs (on c), which nothing can bring about: (on c) by (light c), which may not be used (without what \
         just failed: (light c))"
    ];
    check(DOMAIN, &["on b", "open"], &["(light c)"], &expected);
    let unlock = "(:action unlock :parameters () :effect (open))";
    let shuts = DOMAIN.replace(unlock, "").replace(":effect (on ?l)", ":effect (and (on ?l) (not (open)))");
    let expected = expect![
        "no reachable state satisfies the goal: exhausted: 4 states; the nearest to the goal, after 1 step, misses \
         (on b), (on c); never together: (on a) and (on b); never together: (on a) and (on c); never together: (on b) \
         and (on c)"
    ];
    check(&shuts, &["open"], &[], &expected);
}

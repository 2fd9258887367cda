//! What is advised makes the plan valid, and is the smallest change that was found.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::{Source, parse_domain, parse_plan, parse_problem};
use validator::{AdviceLimits, Validator, Verdict, show_repair};

const HOUSE: &str = "(define (domain house) (:requirements :strips :typing :negative-preconditions)
    (:types room) (:predicates (at ?r - room) (locked ?r - room) (way ?a ?b - room) (key) (lit ?r - room))
    (:action fetch :parameters () :precondition () :effect (key))
    (:action unlock :parameters (?r - room) :precondition (and (key) (locked ?r)) :effect (not (locked ?r)))
    (:action go :parameters (?a ?b - room)
      :precondition (and (at ?a) (way ?a ?b) (not (locked ?b))) :effect (and (at ?b) (not (at ?a))))
    (:action light :parameters (?r - room) :precondition (at ?r) :effect (lit ?r)))";

fn advice_in(domain: &str, problem: &str, plan: &str, budget: AdviceLimits) -> Option<String> {
    let domain = parse_domain(&Source::new("d", domain), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", problem), &domain).model.unwrap();
    let plan = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap();
    let validator = Validator::new(&domain, &problem).unwrap();
    let Verdict::Invalid(failure) = validator.validate(&plan) else { panic!("the plan is valid") };
    let repairs = validator.advise(&plan, &failure, budget);
    Some(show_repair(&domain, &problem, &plan, repairs.first()?))
}

fn house(plan: &str) -> Option<String> {
    let problem = "(define (problem p) (:domain house) (:objects hall cellar attic - room)
        (:init (at hall) (way hall cellar) (way cellar hall) (way hall attic) (locked cellar))
        (:goal (and (lit cellar) (lit hall))))";
    advice_in(HOUSE, problem, plan, AdviceLimits::default())
}

#[test]
fn one_change_of_the_plan() {
    let advice = |plan| house(plan).unwrap();
    assert_eq!(
        advice("(light hall) (fetch) (go hall cellar) (light cellar)"),
        "inserting `(unlock cellar)` before step 3"
    );
    assert_eq!(
        advice("(light hall) (fetch) (go hall cellar) (unlock cellar) (light cellar)"),
        "moving step 4 before step 3"
    );
    assert_eq!(
        advice("(light hall) (fetch) (unlock cellar) (go hall attic) (light cellar)"),
        "making step 4 `(go hall cellar)`"
    );
    assert_eq!(
        advice("(light hall) (fetch) (unlock cellar) (unlock cellar) (go hall cellar) (light cellar)"),
        "leaving out step 4"
    );
    assert_eq!(
        advice("(light hall) (fetch) (unlock cellar) (go hall cellar)"),
        "inserting `(light cellar)` at the end"
    );
}

#[test]
fn one_change_of_the_task() {
    let problem = "(define (problem p) (:domain house) (:objects hall cellar - room)
        (:init (at hall)) (:goal (lit cellar)))";
    let advice = advice_in(HOUSE, problem, "(go hall cellar) (light cellar)", AdviceLimits::default());
    assert_eq!(advice.unwrap(), "adding `(way hall cellar)` to the initial state");
}

#[test]
fn two_changes_are_too_many() {
    assert_eq!(house("(light hall) (go hall attic)"), None);
    let none = AdviceLimits { plans: 0, ..AdviceLimits::default() };
    let problem =
        "(define (problem p) (:domain house) (:objects hall - room) (:init (at hall)) (:goal (lit hall)))";
    assert_eq!(advice_in(HOUSE, problem, "", none), None);
}

#[test]
fn one_change_of_times() {
    let domain = "(define (domain bath) (:requirements :durative-actions) (:predicates (open) (full) (clean))
        (:durative-action fill :parameters () :duration (= ?duration 10)
          :condition (and (at start (clean)) (over all (open))) :effect (at end (full)))
        (:durative-action turn :parameters () :duration (= ?duration 12)
          :condition () :effect (and (at start (open)) (at end (not (open))))))";
    let problem = "(define (problem p) (:domain bath) (:init (clean)) (:goal (full)))";
    let advice = |plan| advice_in(domain, problem, plan, AdviceLimits::default()).unwrap();
    assert_eq!(advice("1.0: (turn) [12]\n9.0: (fill) [10]"), "starting step 2 at 3");
    assert_eq!(advice("1.0: (turn) [12]\n2.0: (fill) [8]"), "letting step 2 take 10 s");
}

//! What is said of a failure: down to the facts behind an axiom, the state that breaks a constraint, and the effects
//! that are in each other's way.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

use pddl::{Source, parse_domain, parse_plan, parse_problem};
use validator::{File, explain, validate};

/// All that is said, the sentence first, each note with its file.
fn said(domain: &str, problem: &str, plan: &str) -> Vec<String> {
    let domain = parse_domain(&Source::new("d", domain), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", problem), &domain).model.unwrap();
    let plan = parse_plan(&Source::new("plan", plan), &domain, &problem).model.unwrap();
    let verdict = validate(&domain, &problem, &plan);
    let finding = explain(&domain, &problem, &plan, &verdict).unwrap();
    let file = |file| match file {
        File::Domain => "domain",
        File::Problem => "problem",
        File::Plan => "plan",
    };
    let notes = finding.notes.iter().map(|(place, note)| format!("{}: {note}", file(place.file)));
    std::iter::once(finding.sentence.clone()).chain(notes).collect()
}

const LAMPS: &str = "(define (domain lamps)
    (:requirements :typing :derived-predicates :constraints :negative-preconditions)
    (:types lamp) (:predicates (on ?l - lamp) (power) (bright ?l - lamp))
    (:derived (bright ?l - lamp) (and (on ?l) (power)))
    (:action switch :parameters (?l - lamp) :precondition (not (on ?l)) :effect (on ?l))
    (:action cut :parameters () :precondition (power) :effect (not (power)))
    (:action read :parameters (?l - lamp) :precondition (bright ?l) :effect (power)))";

#[test]
fn what_does_not_follow_lacks_facts() {
    let problem = "(define (problem p) (:domain lamps) (:objects a - lamp) (:init (power)) (:goal (on a)))";
    assert_eq!(
        said(LAMPS, problem, "(switch a) (cut) (read a)"),
        [
            "step 3 (read a) cannot be taken: its precondition does not hold",
            "domain: (bright a) does not follow",
            "domain: (power) does not hold; step 2 (cut) deleted it",
            "plan: this deletes (power)",
        ]
    );
}

#[test]
fn a_broken_constraint_has_objects_times_and_culprits() {
    let problem = "(define (problem p) (:domain lamps) (:objects a b - lamp) (:init (power))
        (:goal (on a)) (:constraints (and (forall (?l - lamp) (always (or (power) (not (on ?l))))))))";
    assert_eq!(
        said(LAMPS, problem, "(switch b) (cut) (switch a)"),
        [
            "the plan breaks a constraint: after step 3 it does not hold",
            "problem: with ?l = a",
            "problem: no alternative holds: (power) does not hold; step 2 (cut) deleted it | (on a) should not \
             hold; step 3 (switch a) added it",
        ]
    );
}

#[test]
fn two_that_interfere_are_named_with_what_they_do() {
    let domain = "(define (domain rooms) (:requirements :durative-actions) (:predicates (free) (done))
        (:durative-action hold :parameters () :duration (= ?duration 2)
          :condition (at start (free)) :effect (at end (done)))
        (:action take :parameters () :precondition () :effect (not (free))))";
    let problem = "(define (problem p) (:domain rooms) (:init (free)) (:goal (done)))";
    assert_eq!(
        said(domain, problem, "1: (hold) [2]\n1: (take)"),
        [
            "the start of step 1 (hold) at 1 and step 2 (take) at 1 are at one time, and interfere",
            "plan: this needs (free) to stay as it is",
            "domain: the start of step 1 (hold) at 1 needs (free) to stay as it is",
            "plan: this deletes (free), at the same time",
            "domain: step 2 (take) at 1 deletes (free)",
        ]
    );
}

//! Plans of the planner are valid; with a step less, two swapped or an argument changed they are what the definition
//! says, and the step that fails is the one that it says.

use crate::choices::Choices;
use crate::naive::Fault;
use crate::sequential::{compared, steps, task};
use pddl::model::{Domain, Idx, ObjectId, Problem};
use planner::{Budget, GroundOptions, Outcome, Query, SearchConfiguration, ground, solve};
use proptest::prelude::*;
use std::fmt::Write;

const PLAIN: &str = "(define (domain plain) (:requirements :strips :typing)
  (:types place thing) (:predicates (link ?a ?b - place) (here ?p - place) (at ?t - thing ?p - place) (held ?t - thing) (free))
  (:action go :parameters (?a ?b - place) :precondition (and (here ?a) (link ?a ?b)) :effect (and (here ?b) (not (here ?a))))
  (:action take :parameters (?t - thing ?p - place) :precondition (and (here ?p) (at ?t ?p) (free))
    :effect (and (held ?t) (not (at ?t ?p)) (not (free))))
  (:action put :parameters (?t - thing ?p - place) :precondition (and (here ?p) (held ?t))
    :effect (and (at ?t ?p) (free) (not (held ?t)))))";

const CONDITIONAL: &str = "(define (domain conditional) (:requirements :adl :action-costs)
  (:types place thing) (:predicates (link ?a ?b - place) (here ?p - place) (at ?t - thing ?p - place) (held ?t - thing) (free))
  (:functions (total-cost) - number)
  (:action go :parameters (?a ?b - place)
    :precondition (and (here ?a) (or (link ?a ?b) (link ?b ?a)) (not (= ?a ?b)))
    :effect (and (here ?b) (not (here ?a)) (increase (total-cost) 1)
      (forall (?t - thing) (when (held ?t) (and (at ?t ?b) (not (at ?t ?a)))))))
  (:action take :parameters (?t - thing ?p - place)
    :precondition (and (here ?p) (at ?t ?p) (forall (?o - thing) (imply (held ?o) (at ?o ?p))) (not (held ?t)))
    :effect (and (held ?t) (increase (total-cost) 2)))
  (:action put :parameters (?p - place) :precondition (and (here ?p) (exists (?t - thing) (held ?t)))
    :effect (and (increase (total-cost) 1) (forall (?t - thing) (not (held ?t))))))";

const DERIVED: &str = "(define (domain derived) (:requirements :adl :derived-predicates)
  (:types place thing) (:predicates (link ?a ?b - place) (here ?p - place) (at ?t - thing ?p - place) (held ?t - thing) (free)
    (near ?a ?b - place) (lonely ?t - thing))
  (:derived (near ?a ?b - place) (or (link ?a ?b) (exists (?c - place) (and (link ?a ?c) (near ?c ?b)))))
  (:derived (lonely ?t - thing) (not (exists (?p - place) (and (at ?t ?p) (here ?p)))))
  (:action go :parameters (?a ?b - place) :precondition (and (here ?a) (near ?a ?b)) :effect (and (here ?b) (not (here ?a))))
  (:action take :parameters (?t - thing ?p - place) :precondition (and (at ?t ?p) (not (lonely ?t)) (free))
    :effect (and (held ?t) (not (at ?t ?p)) (not (free))))
  (:action put :parameters (?t - thing ?p - place) :precondition (and (here ?p) (held ?t))
    :effect (and (at ?t ?p) (free) (not (held ?t)))))";

/// Places on a line with a few more links, things somewhere, some of them wanted elsewhere.
fn problem(choices: &mut Choices<'_>, domain: &str) -> String {
    let (places, things) = (3 + choices.below(3), 1 + choices.below(3));
    let mut init = "(here p0) (free)".to_owned();
    for place in 1..places {
        write!(init, " (link p{} p{place}) (link p{place} p{})", place - 1, place - 1).unwrap();
    }
    write!(init, " (link p{} p0)", choices.below(places)).unwrap();
    let mut goal = String::new();
    for thing in 0..things {
        write!(init, " (at t{thing} p{})", choices.below(places)).unwrap();
        write!(goal, " (at t{thing} p{})", choices.below(places)).unwrap();
        if choices.one_in(3) {
            write!(goal, " (not (held t{thing}))").unwrap();
        }
    }
    let names = |letter: char, count: usize| (0..count).map(|n| format!("{letter}{n} ")).collect::<String>();
    let cost = if domain == "conditional" { "(= (total-cost) 0)" } else { "" };
    let metric = if domain == "conditional" { "(:metric minimize (total-cost))" } else { "" };
    format!(
        "(define (problem any) (:domain {domain}) (:objects {} - place {} - thing) (:init {init} {cost}) \
         (:goal (and {goal})) {metric})",
        names('p', places),
        names('t', things)
    )
}

/// What the planner finds.
fn plan(domain: &Domain, problem: &Problem) -> Vec<String> {
    let task = ground(domain, problem, &GroundOptions::default()).unwrap();
    let budget = Budget { work: Some(20_000), ..Budget::default() };
    let report = solve(&task, &Query::of(&task), &SearchConfiguration::default(), &budget);
    let Outcome::Solved(plan) = report.outcome else { panic!("every place can be reached") };
    plan.operators.iter().map(|&o| task.operator_name(o)).collect()
}

proptest! {
    #![proptest_config(crate::cases(60))]

    #[test]
    fn plans_are_valid_and_damaged_ones_are_judged_as_defined(bytes in prop::collection::vec(any::<u8>(), 40)) {
        let choices = &mut Choices::new(&bytes);
        let (name, text) = *choices.of(&[("plain", PLAIN), ("conditional", CONDITIONAL), ("derived", DERIVED)]);
        let (domain, problem) = task(text, &problem(choices, name));
        let good = steps(&plan(&domain, &problem).join("\n"), &domain, &problem);
        prop_assert!(compared(&domain, &problem, &good).is_ok());
        for dropped in 0..good.steps.len() {
            let mut less = good.clone();
            less.steps.remove(dropped);
            if let Err(Fault::Precondition(step)) = compared(&domain, &problem, &less) {
                prop_assert!(step >= dropped, "what comes before the dropped step is as it was");
            }
        }
        for first in 0..good.steps.len() {
            for second in first + 1..good.steps.len() {
                let mut swapped = good.clone();
                swapped.steps.swap(first, second);
                if let Err(Fault::Precondition(step)) = compared(&domain, &problem, &swapped) {
                    prop_assert!(step >= first, "what comes before the swapped steps is as it was");
                }
            }
        }
        for step in 0..good.steps.len() {
            for argument in 0..good.steps[step].arguments.len() {
                let had = good.steps[step].arguments[argument];
                let kind = &problem.objects[had].types;
                let others = (0..problem.objects.len()).map(ObjectId::from_index);
                for other in others.filter(|&o| o != had && problem.objects[o].types == *kind) {
                    let mut changed = good.clone();
                    changed.steps[step].arguments[argument] = other;
                    if let Err(Fault::Precondition(at)) = compared(&domain, &problem, &changed) {
                        prop_assert!(at >= step, "what comes before the changed step is as it was");
                    }
                }
            }
        }
    }
}

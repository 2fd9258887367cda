//! Plans of the planner are valid; with a step less, two swapped or an argument changed they are what the definition
//! says, and the step that fails is the one that it says.
//!
//! For random tasks with objects of several types, the definition knows each instance of an action and each state that
//! can be reached: the planner's instances are among them, and its plans and proofs and the validator's verdicts agree.

use crate::choices::Choices;
use crate::naive::{Fault, State, World};
use crate::sample::Sample;
use crate::sequential::{compared, steps, task};
use pddl::model::{Domain, Idx, ObjectId, Problem};
use pddl::{PlanStep, SequentialPlan};
use planner::{Budget, GroundOptions, Outcome, Query, SearchConfiguration, ground, solve};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use std::collections::BTreeSet;
use std::fmt::Write;
use validator::validate;

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

/// So many steps at most: the definition's fractions must fit into a word.
const STEPS: usize = 6;

/// What the definition reaches from the initial state in at most so many states; `None` if there are more.
fn reached(world: &World<'_>, most: usize) -> Option<Vec<(State, Vec<PlanStep>)>> {
    let mut found = vec![(world.initial(), Vec::new())];
    let mut next = 0;
    while let Some((state, steps)) = found.get(next).cloned() {
        next += 1;
        for step in world.instances() {
            if let Some(after) = world.successor(&state, &step)
                && found.iter().all(|(known, _)| *known != after)
            {
                found.push((after, [steps.as_slice(), &[step]].concat()));
            }
        }
        if found.len() > most || found.last().is_some_and(|(_, steps)| steps.len() > STEPS) {
            return None;
        }
    }
    Some(found)
}

/// A step as a pair that can be compared.
fn outline(step: &PlanStep) -> (u32, Vec<ObjectId>) {
    (step.action.0, step.arguments.clone())
}

/// What a comparison of a random task said; for the tally below.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Met {
    Plan,
    Unsolvable,
    /// The task is outside of the planner's language or too large for the definition.
    Nothing,
}

/// Holds the planner's instances, plan or proof and the validator's verdict against the definition.
fn planned(sample: &Sample) -> Met {
    let (domain, problem) = task(&sample.domain(), &sample.problem());
    let world = World { domain: &domain, problem: &problem };
    let Ok(grounded) = ground(&domain, &problem, &GroundOptions::default()) else { return Met::Nothing };
    let instances: BTreeSet<_> = world.instances().iter().map(outline).collect();
    for operator in grounded.operators().iter() {
        let instance = (operator.action.0, operator.arguments.to_vec());
        assert!(instances.contains(&instance), "{instance:?} is not of the right types");
    }
    let all = reached(&world, 150);
    let goal = |(_, steps): &&(State, Vec<PlanStep>)| world.judge(steps).is_ok();
    let shortest = all.as_ref().and_then(|all| all.iter().find(goal));
    if let Some((_, steps)) = shortest {
        let plan = SequentialPlan::new(steps.clone());
        assert!(validate(&domain, &problem, &plan).is_valid(), "{steps:?} is a plan by the definition");
    }
    let budget = Budget { work: Some(20_000), ..Budget::default() };
    match solve(&grounded, &Query::of(&grounded), &SearchConfiguration::default(), &budget).outcome {
        Outcome::Solved(plan) => {
            let names: Vec<_> = plan.operators.iter().map(|&o| grounded.operator_name(o)).collect();
            let plan = steps(&names.join("\n"), &domain, &problem);
            assert!(validate(&domain, &problem, &plan).is_valid(), "{names:?} is no plan");
            assert!(plan.steps.len() > STEPS || compared(&domain, &problem, &plan).is_ok());
            Met::Plan
        }
        Outcome::Unsolvable(_) => {
            assert!(shortest.is_none(), "{shortest:?} is a plan");
            Met::Unsolvable
        }
        _ => Met::Nothing,
    }
}

proptest! {
    #![proptest_config(crate::cases(300))]

    #[test]
    fn the_planner_the_validator_and_the_definition_agree(bytes in prop::collection::vec(any::<u8>(), 400)) {
        planned(&Sample::plannable(&bytes));
    }
}

#[test]
fn random_tasks_have_plans_and_have_none() {
    let mut runner = proptest::test_runner::TestRunner::deterministic();
    let bytes = prop::collection::vec(any::<u8>(), 400);
    let mut kinds = std::collections::BTreeMap::new();
    for _ in 0..200 {
        let sample = Sample::plannable(&bytes.new_tree(&mut runner).unwrap().current());
        *kinds.entry(planned(&sample)).or_insert(0) += 1;
    }
    assert!([Met::Plan, Met::Unsolvable].iter().all(|kind| kinds.get(kind) >= Some(&20)), "{kinds:?}");
}

//! Action costs: the plan minimises them, and monitoring ignores them.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use budget::Cancellation;
use executive::{Decision, GoalId, Model, Monitor, Request, RequestId, decide};
use pddl::model::Name;
use pddl::{Source, parse_domain, parse_problem};
use std::sync::Arc;

/// One dear step does the same as two cheap ones.
const DOMAIN: &str = "(define (domain calls) (:requirements :typing :action-costs) (:types person)
  (:predicates (present ?p - person) (near ?p - person))
  (:functions (total-cost) - number (way ?p - person) - number)
  (:action fetch :parameters (?p - person)
    :effect (and (present ?p) (increase (total-cost) (way ?p))))
  (:action call :parameters (?p - person)
    :effect (and (near ?p) (increase (total-cost) 2)))
  (:action invite :parameters (?p - person)
    :precondition (near ?p)
    :effect (and (present ?p) (increase (total-cost) 3))))";

fn model(way: u32) -> Arc<Model> {
    let problem = format!(
        "(define (problem p) (:domain calls) (:objects ann - person)
           (:init (= (total-cost) 0) (= (way ann) {way}))
           (:goal (present ann)) (:metric minimize (total-cost)))"
    );
    let domain = parse_domain(&Source::new("d", DOMAIN), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", &*problem), &domain).model.unwrap();
    Arc::new(Model::new(domain, problem, &["present", "near"].map(Name::new)).unwrap())
}

fn plan(model: &Arc<Model>) -> Vec<planner::OperatorId> {
    let request = Request {
        id: RequestId(0),
        state: model.task().initial_state().clone(),
        goals: vec![GoalId(0)],
        broken: Vec::new(),
        served: vec![GoalId(0)],
        running: Vec::new(),
        barred: Vec::new(),
        expansions: 1_000,
        arrived: None,
    };
    match decide(model, &request, &Cancellation::default()) {
        Decision::Plan { operators, .. } => operators,
        other => panic!("{other:?}"),
    }
}

fn names(model: &Model, plan: &[planner::OperatorId]) -> Vec<String> {
    plan.iter().map(|&o| model.step(o).to_string()).collect()
}

#[test]
fn the_cheaper_plan_is_chosen_even_if_it_is_longer() {
    let dear = model(9);
    assert_eq!(names(&dear, &plan(&dear)), ["(call ann)", "(invite ann)"]);
    let cheap = model(4);
    assert_eq!(names(&cheap, &plan(&cheap)), ["(fetch ann)"]);
}

#[test]
fn monitoring_ignores_what_was_spent() {
    let model = model(9);
    let (task, steps) = (model.task(), plan(&model));
    let seen = |facts: &[&str]| {
        let facts = facts
            .iter()
            .map(|name| low_to_high::Fact { predicate: Name::new(name), arguments: vec![Name::new("ann")] });
        model.state(&facts.collect::<Vec<_>>())
    };
    let mut monitor = Monitor::new(task, steps, task.goal().clone(), &seen(&[]));
    assert_eq!(monitor.furthest(task), Some(0));
    monitor.observe(task, &seen(&["near"]));
    assert_eq!(monitor.furthest(task), Some(1), "no sensor reports a cost, and the plan still fits");
    monitor.observe(task, &seen(&["near", "present"]));
    assert_eq!(monitor.furthest(task), Some(2));
}

//! Suffix monitoring against its definition: a suffix holds exactly where carrying it out reaches the goal.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use executive::{Decision, GoalId, Model, Monitor, Request, RequestId, decide};
use low_to_high::{Change, Fact};
use pddl::model::Name;
use pddl::{Source, parse_domain, parse_problem};
use planner::{FactId, OperatorId, State};
use proptest::prelude::*;
use std::sync::Arc;

/// Rooms in a row, doors that can be shut, a lamp that must be out before one may leave.
const ROOMS: &str = "(define (domain rooms) (:requirements :strips :typing :negative-preconditions)
  (:types room)
  (:predicates (in ?r - room) (shut ?r - room) (lit ?r - room) (clean ?r - room) (next ?a ?b - room))
  (:action go :parameters (?a ?b - room)
    :precondition (and (in ?a) (next ?a ?b) (not (shut ?b)) (not (lit ?a)))
    :effect (and (not (in ?a)) (in ?b)))
  (:action open :parameters (?a ?b - room)
    :precondition (and (in ?a) (next ?a ?b) (shut ?b)) :effect (not (shut ?b)))
  (:action switch-on :parameters (?r - room)
    :precondition (and (in ?r) (not (lit ?r))) :effect (lit ?r))
  (:action switch-off :parameters (?r - room)
    :precondition (and (in ?r) (lit ?r)) :effect (not (lit ?r)))
  (:action sweep :parameters (?r - room)
    :precondition (and (in ?r) (lit ?r)) :effect (clean ?r)))";

const PROBLEM: &str = "(define (problem three) (:domain rooms) (:objects a b c - room)
  (:init (in a) (next a b) (next b c) (shut b) (shut c))
  (:goal (and (clean a) (clean b) (clean c) (in c) (not (lit c)))))";

/// The same with a conditional effect.
fn with_draught() -> String {
    ROOMS.replace(
        "(and (not (in ?a)) (in ?b))",
        "(and (not (in ?a)) (in ?b) (when (clean ?b) (not (clean ?b))))",
    )
}

fn model(rooms: &str) -> Arc<Model> {
    let domain = parse_domain(&Source::new("d", rooms), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", PROBLEM), &domain).model.unwrap();
    Arc::new(Model::new(domain, problem, &["in", "shut", "lit", "clean"].map(Name::new)).unwrap())
}

fn plan(model: &Arc<Model>) -> Vec<OperatorId> {
    let state = model.task().initial_state().clone();
    let request = Request {
        id: RequestId(0),
        state,
        goals: vec![GoalId(0)],
        broken: Vec::new(),
        served: vec![GoalId(0)],
        running: Vec::new(),
        barred: Vec::new(),
        expansions: 10_000,
        arrived: None,
    };
    match decide(model, &request, &budget::Cancellation::default()) {
        Decision::Plan { operators, .. } => operators,
        other => panic!("{other:?}"),
    }
}

/// Whether the plan can be carried out from here and reaches the goal.
fn reaches(model: &Model, plan: &[OperatorId], state: &State) -> bool {
    let task = model.task();
    task.after(state, plan).is_some_and(|end| task.satisfies(&end, task.goal()))
}

/// By definition: the last suffix that does.
fn furthest(model: &Model, plan: &[OperatorId], state: &State) -> Option<usize> {
    (0..=plan.len()).rev().find(|&start| reaches(model, &plan[start..], state))
}

/// A state on or beside the plan's way: after `steps` of it, with some facts turned round.
fn beside(model: &Model, plan: &[OperatorId], steps: usize, flips: &[usize]) -> State {
    let task = model.task();
    let start = &plan[..steps.min(plan.len())];
    let state = task.after(task.initial_state(), start).expect("it is the plan");
    let all: Vec<FactId> = task.facts().ids().collect();
    let flipped: Vec<FactId> = flips.iter().map(|&i| all[i % all.len()]).collect();
    let holds = |f: &FactId| state.contains(*f) != flipped.contains(f);
    task.state(all.iter().copied().filter(holds))
}

/// Lamps that the robot senses, one that it does not, and axioms over both.
const LAMPS: &str = "(define (domain lamps) (:requirements :adl :derived-predicates)
  (:predicates (lit ?l) (wired ?l) (next ?a ?b) (lamp ?l) (bright) (reached ?l))
  (:derived (bright) (forall (?l) (or (lit ?l) (not (lamp ?l)))))
  (:derived (reached ?l) (or (lit ?l) (exists (?k) (and (next ?k ?l) (reached ?k)))))
  (:action wire :parameters (?l) :precondition (lamp ?l) :effect (wired ?l))
  (:action join :parameters (?a ?b) :precondition (wired ?a) :effect (next ?a ?b))
  (:action light :parameters (?l) :precondition (and (wired ?l) (reached ?l)) :effect (lit ?l)))";

const THREE: &str = "(define (problem three) (:domain lamps) (:objects a b c)
  (:init (lamp a) (lamp b) (lamp c) (lit a) (wired a)) (:goal (and (bright) (reached c))))";

fn sensed(predicate: &str, arguments: &[&str]) -> Fact {
    Fact { predicate: Name::new(predicate), arguments: arguments.iter().map(|a| Name::new(a)).collect() }
}

proptest! {
    #[test]
    fn a_state_that_follows_changes_is_that_of_the_facts(changes in prop::collection::vec(0_usize..8, 1..20)) {
        let domain = parse_domain(&Source::new("d", LAMPS), &[]).model.unwrap();
        let problem = parse_problem(&Source::new("p", THREE), &domain).model.unwrap();
        let model = Model::new(domain, problem, &["lit", "next"].map(Name::new)).unwrap();
        let all = [
            sensed("lit", &["a"]), sensed("lit", &["b"]), sensed("lit", &["c"]),
            sensed("next", &["a", "b"]), sensed("next", &["b", "c"]), sensed("next", &["c", "a"]),
            // Perception may derive what no plan depends on, and what the problem states for good.
            sensed("wired", &["a"]), sensed("unknown", &[]),
        ];
        let mut held = [false; 8];
        let mut state = model.state([]);
        for at in changes {
            held[at] = !held[at];
            let fact = vec![all[at].clone()];
            let change = match held[at] {
                true => Change { appeared: fact, ..Change::default() },
                false => Change { disappeared: fact, ..Change::default() },
            };
            let before = state.clone();
            let changed = !model.update(&mut state, &change).is_empty();
            prop_assert_eq!(&state, &model.state(all.iter().zip(held).filter(|(_, h)| *h).map(|(f, _)| f)));
            prop_assert_eq!(changed, state != before);
        }
    }

    #[test]
    fn monitoring_says_what_carrying_the_suffix_out_says(
        draught: bool,
        path in prop::collection::vec((0_usize..20, prop::collection::vec(0_usize..40, 0..4)), 1..8),
    ) {
        let model = if draught { model(&with_draught()) } else { model(ROOMS) };
        let plan = plan(&model);
        let mut state = model.task().initial_state().clone();
        let mut monitor = Monitor::new(model.task(), plan.clone(), model.task().goal().clone(), &state);
        for (steps, flips) in path {
            let next = beside(&model, &plan, steps, &flips);
            state = next;
            monitor.observe(model.task(), &state);
            let expected = furthest(&model, &plan, &state);
            prop_assert_eq!(monitor.furthest(model.task()), expected);
            for current in 0..=plan.len() {
                let deviation = monitor.deviation(&model, &state, current);
                let fits = reaches(&model, &plan[current..], &state);
                prop_assert_eq!(deviation.broken.is_empty(), fits, "the reason of a deviation is never empty");
            }
        }
    }
}

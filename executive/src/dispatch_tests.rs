//! Random domains with durative actions: whatever the durations and whichever step ends first, what is dispatched by the
//! order of the plan is a plan that the validator accepts. The validator reads the durative actions themselves.

use crate::{Decision, Model, Request, RequestId, decide};
use budget::Cancellation;
use pddl::{Source, parse_domain, parse_plan, parse_problem};
use planner::OperatorId;
use proptest::prelude::*;
use proptest::strategy::ValueTree as _;
use proptest::test_runner::TestRunner;
use std::fmt::Write as _;
use std::sync::Arc;

/// A literal: whether it is positive, its predicate, its argument.
type Literal = (bool, u8, u8);

#[derive(Clone, Debug)]
struct Action {
    conditions: Vec<(u8, Literal)>,
    effects: Vec<(bool, Literal)>,
    /// Whether the place of a hand is taken at the start and given back at the end.
    takes: bool,
    /// Whether a shared number is raised: at the start, at the end.
    raises: (bool, bool),
    least: u8,
    more: u8,
    instant: bool,
}

fn literal() -> impl Strategy<Value = Literal> {
    (prop::bool::weighted(0.75), 0..5_u8, 0..3_u8)
}

fn action() -> impl Strategy<Value = Action> {
    (
        prop::collection::vec((0..3_u8, literal()), 0..3),
        prop::collection::vec((prop::bool::weighted(0.3), literal()), 1..4),
        prop::bool::weighted(0.3),
        any::<(bool, bool)>(),
        (1..20_u8, 0..20_u8, prop::bool::weighted(0.1)),
    )
        .prop_map(|(conditions, effects, takes, raises, (least, more, instant))| Action {
            conditions,
            effects,
            takes,
            raises,
            least,
            more,
            instant,
        })
}

fn text((positive, predicate, argument): Literal) -> String {
    let argument = ["?x", "?y", "a"][usize::from(argument)];
    if positive { format!("(p{predicate} {argument})") } else { format!("(not (p{predicate} {argument}))") }
}

fn domain(actions: &[Action]) -> String {
    let mut out = "(define (domain d) (:requirements :adl :fluents :durative-actions) (:types o)
        (:constants a b - o) (:predicates (p0 ?x - o) (p1 ?x - o) (p2 ?x - o) (p3 ?x - o) (p4 ?x - o)
        (free ?x - o)) (:functions (n))\n"
        .to_owned();
    for (i, action) in actions.iter().enumerate() {
        if action.instant {
            let conditions: String = action.conditions.iter().map(|(_, l)| text(*l)).collect();
            let effects: String = action.effects.iter().map(|(_, l)| text(*l)).collect();
            let _ = writeln!(
                out,
                "(:action a{i} :parameters (?x ?y - o) :precondition (and {conditions}) :effect (and {effects}))"
            );
            continue;
        }
        let when = ["at start", "over all", "at end"];
        let mut conditions: String = action
            .conditions
            .iter()
            .map(|(w, l)| format!("({} {})", when[usize::from(*w)], text(*l)))
            .collect();
        let at = |start: bool| if start { "at start" } else { "at end" };
        let mut effects: String =
            action.effects.iter().map(|(start, l)| format!("({} {})", at(*start), text(*l))).collect();
        if action.takes {
            conditions += "(at start (free ?x))";
            effects += "(at start (not (free ?x))) (at end (free ?x))";
        }
        if action.raises.0 {
            effects += "(at start (increase (n) 1))";
        }
        if action.raises.1 {
            effects += "(at end (increase (n) 1))";
        }
        let (least, most) = (action.least, action.least + action.more);
        let _ = writeln!(
            out,
            "(:durative-action a{i} :parameters (?x ?y - o)
               :duration (and (>= ?duration {least}) (<= ?duration {most}))
               :condition (and {conditions}) :effect (and {effects}))"
        );
    }
    out + ")"
}

/// The text of a plan: each step starts some time after those before it are done, and takes some time.
fn dispatched(
    model: &Model,
    actions: &[Action],
    plan: &[OperatorId],
    times: &[(u16, u16)],
) -> (String, usize) {
    let before = model.order(plan);
    let mut ends: Vec<u64> = Vec::new();
    let mut spans: Vec<(u64, u64)> = Vec::new();
    let mut text = String::new();
    for (step, &operator) in plan.iter().enumerate() {
        let named = model.step(operator);
        let action = &actions[named.action[1..].parse::<usize>().unwrap()];
        let (wait, length) = times[step % times.len()];
        let ready = before[step].iter().map(|&i| ends[i] + 1).max().unwrap_or(1);
        let start = ready + u64::from(wait % 4) * u64::from(wait % 700);
        let length = if action.instant {
            0
        } else {
            u64::from(action.least) * 1000 + u64::from(length) % (u64::from(action.more) * 1000 + 1)
        };
        ends.push(start + length);
        spans.push((start, start + length));
        let seconds = |t: u64| format!("{}.{:03}", t / 1000, t % 1000);
        let _ = write!(text, "{}: {named}", seconds(start));
        text += &if action.instant { "\n".to_owned() } else { format!(" [{}]\n", seconds(length)) };
    }
    let overlap = |(i, a): (usize, &(u64, u64))| spans[..i].iter().filter(|b| a.0 < b.1 && b.0 < a.1).count();
    (text, spans.iter().enumerate().map(overlap).sum())
}

type Case = (Vec<Action>, Vec<(u8, bool)>, Vec<(u8, bool)>, Vec<(u16, u16)>);

fn case() -> impl Strategy<Value = Case> {
    let atoms = |most| prop::collection::vec((0..5_u8, any::<bool>()), 1..most);
    let times = prop::collection::vec(any::<(u16, u16)>(), 1..8);
    (prop::collection::vec(action(), 2..7), atoms(5), atoms(5), times)
}

/// How many pairs of steps overlapped, and how many steps there were.
fn check((actions, initial, goal, times): &Case) -> (usize, usize) {
    let text = domain(actions);
    let atom = |(predicate, is_a): &(u8, bool)| format!("(p{predicate} {})", if *is_a { "a" } else { "b" });
    let (init, goal): (String, String) =
        (initial.iter().map(atom).collect(), goal.iter().map(atom).collect());
    let problem = format!(
        "(define (problem p) (:domain d) (:init (= (n) 0) (free a) (free b) {init}) (:goal (and {goal})))"
    );
    let domain = parse_domain(&Source::new("d", text.as_str()), &[]).model.unwrap();
    let problem = parse_problem(&Source::new("p", problem.as_str()), &domain).model.unwrap();
    // What needs concurrency, or is not followed, is refused.
    let Ok(model) = Model::new(domain.clone(), problem.clone(), &[]) else { return (0, 0) };
    let model = Arc::new(model);
    let request = Request {
        id: RequestId(0),
        state: model.task().initial_state().clone(),
        goals: vec![crate::GoalId(0)],
        broken: Vec::new(),
        served: Vec::new(),
        running: Vec::new(),
        barred: Vec::new(),
        expansions: 2_000,
        arrived: None,
    };
    let Decision::Plan { operators, .. } = decide(&model, &request, &Cancellation::default()) else {
        return (0, 0);
    };
    let (plan_text, overlaps) = dispatched(&model, actions, &operators, times);
    let parsed = parse_plan(&Source::new("plan", plan_text.as_str()), &domain, &problem);
    if let pddl::Plan::Temporal(plan) = parsed.model.expect("the plan is well formed") {
        let verdict = validator::validate(&domain, &problem, &plan);
        assert!(matches!(verdict, validator::Verdict::Valid(_)), "{text}\n{plan_text}\n{verdict:?}");
    }
    (overlaps, operators.len())
}

#[test]
fn every_dispatch_is_a_valid_plan() {
    let mut runner = TestRunner::deterministic();
    let (mut plans, mut together) = (0, 0);
    for _ in 0..800 {
        let (overlaps, steps) = check(&case().new_tree(&mut runner).unwrap().current());
        plans += usize::from(steps > 1);
        together += usize::from(overlaps > 0);
    }
    assert!(
        plans >= 60 && together >= 20,
        "{plans} plans of several steps, {together} with steps that overlap"
    );
}

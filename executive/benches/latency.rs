//! From a delta to a decision, where nothing is wrong: 10,000 facts, a plan of 100 steps with conditional effects, and
//! axioms over the facts. Prints percentiles, and those of what monitoring did before: the state built from all facts,
//! and every suffix simulated.
//!
//!     cargo bench -p pelea-executive --bench latency

#![allow(clippy::unwrap_used, reason = "a bench stops by panicking")]
#![allow(clippy::print_stdout, reason = "the figures are what it is for")]

use budget::Cancellation;
use dsr::{Edit, Graph, Time, Transaction};
use executive::{
    Decision, Effect, Event, GoalId, Model, Monitor, Policy, Request, RequestId, Step, Wheel, decide,
};
use high_to_low::Methods;
use low_to_high::{Change, Fact, Perception};
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use planner::{OperatorId, State};
use std::collections::VecDeque;
use std::fmt::Write;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};
use vocabulary::Tokens;

/// Cells; each pair of them may be seen to touch.
const CELLS: usize = 101;
const ROUNDS: usize = 20_000;

const VOCABULARY: &str = "(define (domain yard)
  (:requirements :typing :equality :fluents :vocabulary)
  (:types agent resource symbol - object cell state - symbol)
  (:constants pelea scout - agent wanted here done wet muddy - state)
  (:predicates (is ?c - cell ?s - state) (touches ?a ?b - cell))
  (:writes pelea (is _ wanted))
  (:writes scout (is _ here) (is _ done) (is _ wet) (is _ muddy) touches))";

const DOMAIN: &str = "(define (domain sweeping)
  (:requirements :adl :typing :derived-predicates)
  (:types cell)
  (:predicates (seen ?a ?b - cell) (at ?c - cell) (done ?c - cell) (wet ?c - cell) (muddy ?c - cell)
    (next ?a ?b - cell) (safe ?c - cell) (calm ?c - cell))
  (:derived (safe ?c - cell) (exists (?d - cell) (seen ?c ?d)))
  (:derived (calm ?c - cell) (and (safe ?c) (not (muddy ?c))))
  (:action sweep :parameters (?a ?b - cell)
    :precondition (and (at ?a) (next ?a ?b) (safe ?b))
    :effect (and (not (at ?a)) (at ?b) (done ?a) (when (wet ?b) (muddy ?b)) (when (not (wet ?a)) (not (muddy ?a))))))";

const PERCEPTION: &str = "(define (domain sweeping-perception)
  (:requirements :typing :derived-predicates)
  (:import yard sweeping)
  (:derived (seen ?a ?b - cell) (touches ?a ?b))
  (:derived (at ?c - cell) (is ?c here))
  (:derived (done ?c - cell) (is ?c done))
  (:derived (wet ?c - cell) (is ?c wet))
  (:derived (muddy ?c - cell) (is ?c muddy)))";

const METHODS: &str = "(define (domain sweeping-methods)
  (:requirements :typing :durative-actions :hierarchy)
  (:import yard)
  (:durative-action want :parameters (?c - cell) :duration (<= ?duration 500)
    :effect (and (at start (is ?c wanted)) (at end (is ?c here))))
  (:task sweep :parameters (?a ?b - cell))
  (:method by-wanting-it :parameters (?a ?b - cell) :task (sweep ?a ?b) :ordered-subtasks (want ?b))
  (:task give-up :parameters (?c - cell))
  (:method by-doing-nothing :parameters (?c - cell) :task (give-up ?c) :ordered-subtasks ()))";

fn domain(text: &str, imports: &[&Domain]) -> Domain {
    let source = Source::new("d", text);
    let parsed = parse_domain(&source, imports);
    parsed.model.unwrap_or_else(|| panic!("{}", parsed.diagnostics[0].describe(&source)))
}

fn cells() -> impl Iterator<Item = String> {
    (0..CELLS).map(|i| format!("c{i}"))
}

fn high_level() -> (Domain, pddl::model::Problem) {
    let sweeping = domain(DOMAIN, &[]);
    let objects: Vec<String> = cells().collect();
    let mut text =
        format!("(define (problem p) (:domain sweeping) (:objects {} - cell)\n(:init", objects.join(" "));
    for i in 1..CELLS {
        write!(text, " (next c{} c{i})", i - 1).unwrap();
    }
    text.push_str(")\n(:goal (and");
    for i in 1..CELLS {
        write!(text, " (done c{}) (calm c{i})", i - 1).unwrap();
    }
    text.push_str(")))");
    let problem = parse_problem(&Source::new("p", text), &sweeping).model.unwrap();
    (sweeping, problem)
}

fn model() -> Arc<Model> {
    let (domain, problem) = high_level();
    let perceived = ["seen", "at", "done", "wet", "muddy"].map(Name::new);
    Arc::new(Model::new(domain, problem, &perceived).unwrap())
}

fn fact(predicate: &str, arguments: &[&str]) -> Fact {
    Fact { predicate: Name::new(predicate), arguments: arguments.iter().map(|a| Name::new(a)).collect() }
}

/// The pairs of cells that touch at the start.
fn touching() -> Vec<(String, String)> {
    let pairs = cells().flat_map(|a| cells().map(move |b| (a.clone(), b)));
    pairs.filter(|(a, b)| a != b && b != "c7").collect()
}

fn perceived() -> Vec<Fact> {
    let seen = touching().into_iter().map(|(a, b)| fact("seen", &[&a, &b]));
    seen.chain([fact("at", &["c0"])]).collect()
}

/// A fact that comes or goes and does not break the plan: one of many cells that touch another, which axioms read; or mud
/// that a conditional effect removes on the way.
fn harmless(round: usize) -> (bool, String) {
    let cell = 1 + round * 37 % (CELLS - 2);
    (round.is_multiple_of(2) && cell != 7, format!("c{cell}"))
}

fn percentiles(name: &str, mut times: Vec<Duration>) {
    times.sort_unstable();
    let at = |share: f64| {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            clippy::cast_precision_loss,
            reason = "few"
        )]
        let i = (times.len() as f64 * share) as usize;
        times[i.min(times.len() - 1)].as_secs_f64() * 1e6
    };
    println!("| {name} | {:.1} µs | {:.1} µs | {:.1} µs | {:.1} µs |", at(0.5), at(0.9), at(0.99), at(0.999));
}

fn plan(model: &Arc<Model>, state: &State) -> Vec<OperatorId> {
    let (state, broken, barred) = (state.clone(), Vec::new(), Vec::new());
    let request = Request {
        id: RequestId(0),
        state,
        goals: vec![GoalId(0)],
        broken,
        served: vec![GoalId(0)],
        running: Vec::new(),
        barred,
        expansions: 20_000,
        arrived: None,
    };
    match decide(model, &request, &Cancellation::default()) {
        Decision::Plan { operators, .. } => operators,
        other => panic!("{other:?}"),
    }
}

/// Monitoring alone: from the changed facts to the furthest suffix.
fn monitoring() {
    let model = model();
    let task = model.task();
    let mut facts: std::collections::BTreeSet<Fact> = perceived().into_iter().collect();
    let mut state = model.state(&facts);
    let plan = plan(&model, &state);
    let started = Instant::now();
    let mut monitor = Monitor::new(task, plan.clone(), task.goal().clone(), &state);
    println!(
        "{} facts of the task, {} steps, {} rules of axioms; regressed in {:.1} ms, {} suffixes simulated\n",
        task.facts().len(),
        plan.len(),
        task.axioms().len(),
        started.elapsed().as_secs_f64() * 1e3,
        monitor.exact_from()
    );
    println!("| | p50 | p90 | p99 | p99.9 |\n|---|---|---|---|---|");
    let (mut rebuilt, mut simulated, mut now) = (Vec::new(), Vec::new(), Vec::new());
    for round in 0..ROUNDS {
        let (touches, cell) = harmless(round);
        let one = if touches { fact("seen", &[&cell, "c7"]) } else { fact("muddy", &[&cell]) };
        let mut change = Change::default();
        if facts.remove(&one) {
            change.disappeared.push(one);
        } else {
            facts.insert(one.clone());
            change.appeared.push(one);
        }
        if round.is_multiple_of(100) {
            let start = Instant::now();
            let whole = black_box(model.state(&facts));
            rebuilt.push(start.elapsed());
            let start = Instant::now();
            let reaches = |from: &usize| {
                task.after(&whole, &plan[*from..]).is_some_and(|end| task.satisfies(&end, task.goal()))
            };
            assert_eq!((0..=plan.len()).rev().find(reaches), Some(0));
            simulated.push(start.elapsed());
        }
        let start = Instant::now();
        black_box(model.update(&mut state, &change));
        monitor.observe(task, &state);
        let furthest = monitor.furthest(task);
        now.push(start.elapsed());
        assert_eq!(furthest, Some(0));
    }
    percentiles("before: the state from all facts", rebuilt);
    percentiles("before: each suffix simulated", simulated);
    percentiles("now: state, conditions, furthest suffix", now);
}

struct Yard {
    graph: Graph,
    subscription: dsr::Subscription,
    wheel: Wheel,
}

impl Yard {
    fn new() -> Self {
        let yard = domain(VOCABULARY, &[]);
        let sweeping = domain(DOMAIN, &[]);
        let tokens = Tokens::new(&yard).unwrap();
        let objects: Vec<String> = cells().collect();
        let world = format!(
            "(define (problem w) (:domain yard) (:objects {} - cell) (:init) (:goal (and)))",
            objects.join(" ")
        );
        let world = parse_problem(&Source::new("w", world), &yard).model.unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        let perception = domain(PERCEPTION, &[&yard, &sweeping]);
        let perception = Arc::new(Perception::new(&perception, &tokens).unwrap());
        let methods = Arc::new(Methods::new(&domain(METHODS, &[&yard]), &tokens).unwrap());
        let fallback = Step { action: Name::new("give-up"), arguments: vec![Name::new("c0")] };
        let wheel = Wheel::new(model(), perception, methods, Policy::new(fallback));
        let pelea = graph.vocabulary().agent("pelea").unwrap();
        let mut subscription = graph.subscribe_to(wheel.interest(pelea));
        subscription.try_recv();
        let mut yard = Self { graph, subscription, wheel };
        let edges = touching().into_iter().map(|(a, b)| yard.edge(&a, "touches", &b, true));
        let edges: Vec<Edit> = edges.chain([yard.edge("c0", "is", "here", true)]).collect();
        yard.commit("scout", edges);
        yard.news();
        let snapshot = yard.graph.snapshot();
        yard.turn(Event::Seen(snapshot));
        yard
    }

    fn edge(&self, from: &str, label: &str, to: &str, add: bool) -> Edit {
        let label = self.graph.vocabulary().label(label).unwrap();
        let (from, to) = (from.into(), to.into());
        if add { Edit::AddEdge { from, label, to } } else { Edit::RemoveEdge { from, label, to } }
    }

    fn commit(&self, agent: &str, edits: Vec<Edit>) {
        let mut transaction = Transaction::new(self.graph.vocabulary().agent(agent).unwrap());
        transaction.extend(edits);
        self.graph.commit(&transaction, Time(0)).unwrap();
    }

    fn news(&mut self) -> Vec<Event> {
        let changed = |mut news: dsr::News| Event::Changed {
            delta: news.deltas.pop().unwrap(),
            snapshot: news.snapshot,
        };
        std::iter::from_fn(|| self.subscription.try_recv()).map(changed).collect()
    }

    fn turn(&mut self, event: Event) {
        let mut events = VecDeque::from([event]);
        while let Some(event) = events.pop_front() {
            for effect in self.wheel.step(event, Time(0)) {
                match effect {
                    Effect::Write(edits) => {
                        self.commit("pelea", edits);
                        events.extend(self.news());
                        events.push_back(Event::Written);
                    }
                    Effect::Plan(request) => {
                        let decision = decide(self.wheel.model(), &request, &Cancellation::default());
                        events.push_back(Event::Decided(request.id, decision));
                    }
                    _ => {}
                }
            }
        }
    }
}

/// The whole wheel: from a delta of the graph to its effects.
fn wheel() {
    let mut yard = Yard::new();
    let (mut times, mut present) = (Vec::new(), std::collections::BTreeSet::new());
    for round in 0..ROUNDS {
        let (touches, cell) = harmless(round);
        let (label, to) = if touches { ("touches", "c7") } else { ("is", "muddy") };
        let add = present.insert((touches, cell.clone())) || !present.remove(&(touches, cell.clone()));
        yard.commit("scout", vec![yard.edge(&cell, label, to, add)]);
        for event in yard.news() {
            let start = Instant::now();
            let effects = black_box(yard.wheel.step(event, Time(0)));
            times.push(start.elapsed());
            assert!(
                !effects.iter().any(|e| matches!(e, Effect::Plan(_) | Effect::Write(_))),
                "nothing is wrong"
            );
        }
    }
    assert_eq!(times.len(), ROUNDS, "each commit concerns the wheel");
    yard.commit("scout", vec![yard.edge("c0", "is", "here", false)]);
    let effects: Vec<Effect> = yard.news().into_iter().flat_map(|e| yard.wheel.step(e, Time(0))).collect();
    assert!(
        effects.iter().any(|e| matches!(e, Effect::Plan(_))),
        "a plan was under way, and now it is broken"
    );
    percentiles("now: a turn of the wheel", times);
}

fn main() {
    monitoring();
    wheel();
}

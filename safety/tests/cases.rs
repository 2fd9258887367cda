//! Every `cases/*.case`: an invariant and traces, and what the monitor finds in each.
//!
//! The file begins with the invariant. A line `trace NAME` begins a trace. Each further line is a commit: a time in
//! seconds, then tokens that appear (`+ ann is ringing`), disappear (`- …`), or nodes that are added (`* cem`); the last
//! line is `TIME end`. What is found stands beside it in `NAME.expected`; `UPDATE_EXPECT=1` writes it.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use dsr::{AgentId, Graph, Subscription, Time, Transaction};
use expect_test::expect_file;
use pddl::{Source, parse_domain, parse_problem};
use safety::{Broken, Invariants, Monitor};
use std::fmt::Write as _;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;
use vocabulary::Tokens;

const WARD: &str = "(define (domain ward) (:requirements :typing :vocabulary)
    (:types person nurse state - object) (:constants ringing heard calm - state)
    (:predicates (is ?p - person ?s - state) (helps ?n - nurse ?p - person)))";

const WORLD: &str = "(define (problem world) (:domain ward)
    (:objects ann bob - person tom - nurse) (:init (is bob calm)) (:goal (and)))";

struct Ward {
    tokens: Tokens,
    invariants: Arc<Invariants>,
    world: pddl::model::Problem,
}

impl Ward {
    fn new(invariant: &str) -> Self {
        let ward = parse_domain(&Source::new("ward.pddl", WARD), &[]).model.unwrap();
        let tokens = Tokens::new(&ward).unwrap();
        let world = parse_problem(&Source::new("world.pddl", WORLD), &ward).model.unwrap();
        let text = format!(
            "(define (domain case) (:requirements :adl :constraints :invariants) (:import ward)
            (:constants ann bob - person tom - nurse)\n{invariant})"
        );
        let nodes = pddl::model::Domain { constants: world.objects.clone(), ..ward };
        let source = Source::new("case.pddl", text);
        let parsed = parse_domain(&source, &[&nodes]);
        let domain = parsed.model.unwrap_or_else(|| panic!("{:?}", parsed.diagnostics));
        let invariants = Invariants::new([&domain], &tokens).unwrap_or_else(|errors| panic!("{errors:?}"));
        Self { tokens, invariants: Arc::new(invariants), world }
    }

    fn play(&self, trace: &str) -> Vec<Broken> {
        let graph = self.tokens.populate(&[&self.world], Time(0)).unwrap();
        let mut monitor = Monitor::new(Arc::clone(&self.invariants));
        let mut subscription = graph.subscribe_to(monitor.interest(&graph.snapshot()));
        let mut broken = look(&mut monitor, &mut subscription);
        for line in trace.lines().filter(|line| !line.trim().is_empty()) {
            let (seconds, what) = line.trim().split_once(' ').unwrap();
            let time = Time(Duration::from_secs_f64(seconds.parse().unwrap()).as_nanos().try_into().unwrap());
            if what == "end" {
                broken.extend(monitor.ended(time));
                return broken;
            }
            if what == "cut" {
                broken.extend(monitor.cut(time));
                return broken;
            }
            commit(&graph, what, time);
            broken.extend(look(&mut monitor, &mut subscription));
        }
        panic!("a trace has an end");
    }
}

fn look(monitor: &mut Monitor, subscription: &mut Subscription) -> Vec<Broken> {
    let mut broken = Vec::new();
    while let Some(news) = subscription.try_recv() {
        broken.extend(monitor.changed(&news));
    }
    broken
}

fn commit(graph: &Graph, what: &str, time: Time) {
    let snapshot = graph.snapshot();
    let mut transaction = Transaction::new(AgentId::DSR);
    for edit in what.split(", ") {
        let (sign, token) = edit.split_once(' ').unwrap();
        let words: Vec<&str> = token.split(' ').collect();
        let node = |name: &str| snapshot.node(name).unwrap_or_else(|| panic!("no node {name}"));
        let vocabulary = graph.vocabulary();
        match (sign, words.as_slice()) {
            ("*", [name]) => {
                transaction.add_node(*name, vocabulary.node_type("person").unwrap());
            }
            ("+", [from, label, to]) => {
                transaction.add_edge(node(from), vocabulary.label(label).unwrap(), node(to));
            }
            ("-", [from, label, to]) => {
                transaction.remove_edge(node(from), vocabulary.label(label).unwrap(), node(to));
            }
            _ => panic!("{edit}"),
        }
    }
    graph.commit(&transaction, time).unwrap();
}

#[test]
fn each_constraint_breaks_where_it_should() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let mut cases: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.retain(|path| path.extension().is_some_and(|e| e == "case"));
    cases.sort();
    assert!(cases.len() > 10, "only {} cases were found", cases.len());
    for case in cases {
        let text = std::fs::read_to_string(&case).unwrap();
        let mut parts = text.split("\ntrace ");
        let ward = Ward::new(parts.next().unwrap());
        let mut found = String::new();
        for part in parts {
            let (name, trace) = part.split_once('\n').unwrap();
            let broken = ward.play(trace);
            if broken.is_empty() {
                writeln!(found, "{name}: holds").unwrap();
            }
            for broken in broken {
                let seconds = broken.time.0 as f64 / 1e9;
                writeln!(found, "{name}: at {seconds} s {broken}").unwrap();
            }
        }
        expect_file![case.with_extension("expected")].assert_eq(&found);
    }
}

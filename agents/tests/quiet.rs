//! Whatever the rules of however many agents, they are quiet after a bounded number of commits in one instant.
#![allow(clippy::unwrap_used, reason = "a test")]

mod common;

use std::fmt::Write;
use std::sync::Arc;

use agents::{Action, Agent, Ended, InstanceId, Outcome, Runtime, compile, skills};
use common::at;
use dsr::{Graph, Subscription, Time};
use pddl::{Source, parse_domain, parse_problem};
use proptest::collection::vec;
use proptest::prelude::*;
use vocabulary::Tokens;

const PREDICATES: usize = 3;
const AGENTS: usize = 3;
const RULES: usize = 3;
/// Two robots and two things.
const BINDINGS: usize = 4;
/// At most two beginnings within an instant.
const BEGINNINGS: usize = 2;
/// At most: resources taken; begun; three endings of which two are refused; given back.
const COMMITS: usize = 6;

/// `(p0 ?r ?t)`, or its negation.
#[derive(Debug, Clone)]
struct Literal {
    predicate: usize,
    holds: bool,
}

impl Literal {
    fn text(&self) -> String {
        let atom = format!("(p{} ?r ?t)", self.predicate);
        if self.holds { atom } else { format!("(not {atom})") }
    }
}

#[derive(Debug, Clone)]
struct Rule {
    before: Vec<Literal>,
    over_all: Vec<Literal>,
    start: Vec<Literal>,
    end: Vec<Literal>,
    abort: Vec<Literal>,
    failure: Vec<Literal>,
    claims: Vec<usize>,
    priority: usize,
    has_skill: bool,
}

impl Rule {
    fn text(&self, name: &str) -> String {
        let mut text =
            format!("(:durative-action {name} :parameters (?r - robot ?t - thing) :condition (and");
        let timed = |text: &mut String, when: &str, literals: &[Literal]| {
            literals.iter().for_each(|literal| write!(text, " ({when} {})", literal.text()).unwrap());
        };
        timed(&mut text, "at start", &self.before);
        if !self.has_skill {
            // It must undo its own condition.
            let trigger = self.before.first().cloned().unwrap_or(Literal { predicate: 0, holds: true });
            let mut start = self.start.clone();
            start.retain(|literal| literal.predicate != trigger.predicate);
            start.push(Literal { holds: !trigger.holds, ..trigger.clone() });
            timed(&mut text, "at start", &[trigger]);
            text += ") :effect (and";
            timed(&mut text, "at start", &start);
            return text + "))";
        }
        timed(&mut text, "over all", &self.over_all);
        text += ") :effect (and";
        timed(&mut text, "at start", &self.start);
        timed(&mut text, "at end", &self.end);
        if !self.over_all.is_empty() || !self.claims.is_empty() {
            timed(&mut text, "at abort", &self.abort);
        }
        timed(&mut text, "at failure", &self.failure);
        text += ") :skill (await-loss)";
        if !self.claims.is_empty() {
            let claims: Vec<_> = self.claims.iter().map(|claim| format!("r{claim}")).collect();
            write!(text, " :claims ({}) :priority {}", claims.join(" "), self.priority).unwrap();
        }
        text + ")"
    }
}

fn literals(most: usize) -> impl Strategy<Value = Vec<Literal>> {
    vec((0..PREDICATES, any::<bool>()).prop_map(|(predicate, holds)| Literal { predicate, holds }), 0..=most)
}

fn rule() -> impl Strategy<Value = Rule> {
    let effects = (literals(2), literals(2), literals(2), literals(1));
    let claims = proptest::sample::subsequence(vec![0, 1], 0..=2);
    (literals(2), literals(2), effects, claims, 0..3_usize, any::<bool>()).prop_map(
        |(before, over_all, (start, end, abort, failure), claims, priority, has_skill)| {
            let priority = priority * 50;
            Rule { before, over_all, start, end, abort, failure, claims, priority, has_skill }
        },
    )
}

/// One agent in the world.
struct Driven {
    runtime: Runtime,
    subscription: Subscription,
    running: Vec<InstanceId>,
}

struct World {
    graph: Graph,
    agents: Vec<Driven>,
    /// How each skill ends that is asked: not at all, well, or with a failure.
    endings: std::iter::Cycle<std::vec::IntoIter<u8>>,
}

impl World {
    fn new(rules: &[Vec<Rule>], holds: &[Literal], endings: Vec<u8>) -> Self {
        let predicates: String = (0..PREDICATES).map(|p| format!("(p{p} ?r - robot ?t - thing)")).collect();
        let writes: String = (0..AGENTS).map(|a| format!("(:writes a{a} p0 p1 p2)")).collect();
        let words = format!(
            "(define (domain words) (:requirements :typing :vocabulary)
               (:types symbol agent resource - object robot thing - symbol)
               (:constants a0 a1 a2 - agent r0 r1 - resource)
               (:predicates {predicates}) {writes})"
        );
        let words = parse_domain(&Source::new("words.pddl", words), &[]).model.unwrap();
        let tokens = Tokens::new(&words).unwrap();
        let facts = holds.iter().zip(["c0 t0", "c0 t1", "c1 t0", "c1 t1"].iter().cycle());
        let facts = facts.filter(|(literal, _)| literal.holds);
        let facts: String = facts.map(|(literal, of)| format!("(p{} {of})", literal.predicate)).collect();
        let world = format!(
            "(define (problem world) (:domain words) (:objects c0 c1 - robot t0 t1 - thing)
               (:init {facts}) (:goal (and)))"
        );
        let world = parse_problem(&Source::new("world.pddl", world), &words).model.unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        let agents = rules.iter().enumerate().map(|(number, rules)| {
            let rules: String =
                rules.iter().enumerate().map(|(at, rule)| rule.text(&format!("rule{at}"))).collect();
            let text = format!(
                "(define (domain a{number}) (:requirements :typing :negative-preconditions
                   :durative-actions :agent-rules) (:import words) {rules})"
            );
            let parsed = parse_domain(&Source::new("agent.pddl", text), &[&words]);
            let agent = compile(&parsed.model.unwrap(), &tokens, &skills::standard());
            let agent: Arc<Agent> = agent.unwrap_or_else(|errors| panic!("{errors:?}")).into();
            let subscription = graph.subscribe_to(agent.interest());
            Driven { runtime: Runtime::new(agent), subscription, running: Vec::new() }
        });
        let agents = agents.collect();
        Self { graph, agents, endings: endings.into_iter().cycle() }
    }

    /// Drives all agents until none has anything to do, with at most so many commits.
    fn settle(&mut self, now: Time, most: usize) {
        let mut commits = 0;
        loop {
            let mut idle = true;
            for agent in &mut self.agents {
                while let Some(committed) = agent.turn(&self.graph, now) {
                    idle = false;
                    commits += usize::from(committed);
                    assert!(commits <= most, "never quiet");
                }
                for instance in std::mem::take(&mut agent.running) {
                    let ended = match self.endings.next() {
                        Some(1) => Ended::well(Vec::new()),
                        Some(2) => Ended::otherwise(Outcome::FAILURE),
                        _ => {
                            agent.running.push(instance);
                            continue;
                        }
                    };
                    agent.runtime.ended(instance, ended);
                    idle = false;
                }
            }
            if idle {
                return;
            }
        }
    }
}

impl Driven {
    /// One step; whether it was a commit.
    fn turn(&mut self, graph: &Graph, now: Time) -> Option<bool> {
        while let Some(news) = self.subscription.try_recv() {
            self.runtime.changed(&news);
        }
        match self.runtime.next_action(&graph.snapshot(), now)? {
            Action::Commit(transaction) => {
                let before = graph.snapshot().version();
                let result = graph.commit(&transaction, now);
                self.runtime.committed(result.as_ref(), now);
                return Some(graph.snapshot().version() > before);
            }
            Action::Launch { instance, .. } => self.running.push(instance),
            Action::Stop(instance) => self.running.retain(|running| *running != instance),
        }
        Some(false)
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1024) })]

    #[test]
    fn every_set_of_rules_is_quiet_within_an_instant(
        rules in vec(vec(rule(), 1..=RULES), 1..=AGENTS),
        holds in vec((0..PREDICATES, any::<bool>()), 4..12),
        endings in vec(0..3_u8, 1..8),
    ) {
        let holds: Vec<_> = holds.into_iter().map(|(predicate, holds)| Literal { predicate, holds }).collect();
        let keys = rules.iter().map(Vec::len).sum::<usize>() * BINDINGS;
        let mut world = World::new(&rules, &holds, endings);
        let mut now = at(1);
        for _ in 0..8 {
            world.settle(now, keys * BEGINNINGS * COMMITS);
            let next = world.agents.iter().filter_map(|agent| agent.runtime.deadline()).min();
            now = next.unwrap_or(now).max(Time(now.0 + 1));
        }
    }
}

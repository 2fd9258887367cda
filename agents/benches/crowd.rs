//! What a crowd costs an agent that it does not concern: a thousand people move at 30 Hz beside CLARC's Speech agent.
//!
//! Three ways in one run: no subscriber; Speech takes every delta and asks which rules it touches, as it did before it
//! had an interest; Speech subscribes to the patterns of its rules. Each time is that of a commit and of what Speech does
//! about it.

#![allow(clippy::unwrap_used, reason = "a bench fails by panicking")]

use std::fs;
use std::hint::black_box;
use std::path::Path;

use agents::{Action, Agent, Runtime, compile, skills};
use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use dsr::{AgentId, Deltas, Event, Graph, Isometry3, Mentions, Subscription, Time, Transaction};
use pddl::model::{Domain, TimeSpecifier};
use pddl::{Source, parse_domain, parse_problem};
use vocabulary::Tokens;

const PEOPLE: usize = 1_000;

fn read(path: &str) -> Source {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/clarc").join(path);
    Source::new(path.display().to_string(), fs::read_to_string(&path).unwrap())
}

struct Crowd {
    graph: Graph,
    speech: Domain,
    tokens: Tokens,
    people: Vec<String>,
    step: u32,
}

impl Crowd {
    fn new() -> Self {
        let words = parse_domain(&read("vocabulary.pddl"), &[]).model.unwrap();
        let speech = parse_domain(&read("agents/speech.pddl"), &[&words]).model.unwrap();
        let world = parse_problem(&read("world.pddl"), &words).model.unwrap();
        let tokens = Tokens::new(&words).unwrap();
        let graph = tokens.populate(&[&world], Time(0)).unwrap();
        let person = graph.vocabulary().node_type("person").unwrap();
        let people: Vec<_> = (0..PEOPLE).map(|at| format!("person{at}")).collect();
        graph
            .edit(AgentId::DSR, Time(0), |tx| {
                for name in &people {
                    tx.add_node(name.as_str(), person).set_transform("world", name.as_str(), pose(0));
                }
            })
            .unwrap();
        Self { graph, speech, tokens, people, step: 0 }
    }

    fn agent(&self) -> Agent {
        compile(&self.speech, &self.tokens, &skills::standard()).unwrap()
    }

    /// One person moves.
    fn one(&mut self) -> Transaction {
        self.step += 1;
        let name = &self.people[self.step as usize % PEOPLE];
        let mut transaction = Transaction::new(AgentId::DSR);
        transaction.set_transform("world", name.as_str(), pose(self.step));
        transaction
    }

    /// All of them move, as one camera sees them.
    fn all(&mut self) -> Transaction {
        self.step += 1;
        let mut transaction = Transaction::new(AgentId::DSR);
        for name in &self.people {
            transaction.set_transform("world", name.as_str(), pose(self.step));
        }
        transaction
    }
}

fn pose(step: u32) -> Isometry3<f64> {
    Isometry3::translation(f64::from(step % 97) / 10.0, f64::from(step % 89) / 10.0, 0.0)
}

/// What Speech does about a commit.
trait Listener {
    fn react(&mut self, graph: &Graph);
}

struct Absent;

impl Listener for Absent {
    fn react(&mut self, _: &Graph) {}
}

/// Every delta, compared with the tokens of each rule.
struct EveryDelta {
    deltas: Deltas,
    rules: Vec<Mentions>,
    runtime: Runtime,
}

impl EveryDelta {
    fn new(crowd: &Crowd) -> Self {
        let link = crowd.tokens.link(&crowd.speech);
        let before = |when: &TimeSpecifier| matches!(when, TimeSpecifier::Start | TimeSpecifier::OverAll);
        let rules = crowd.speech.durative_actions.iter().map(|rule| {
            let conditions = rule.conditions.iter().filter(|timed| before(&timed.when));
            let conditions = conditions.map(|timed| &timed.condition);
            link.condition(&rule.variables, conditions).unwrap().mentions().clone()
        });
        let rules = rules.collect();
        Self { deltas: crowd.graph.subscribe_deltas(), rules, runtime: Runtime::new(crowd.agent().into()) }
    }
}

impl Listener for EveryDelta {
    fn react(&mut self, graph: &Graph) {
        while let Some(event) = self.deltas.try_recv() {
            if let Event::Committed(committed) = event {
                let touched = Mentions::of(&committed.delta);
                black_box(self.rules.iter().any(|rule| rule.intersects(&touched)));
            }
        }
        assert!(self.runtime.next_action(&graph.snapshot(), Time(1)).is_none());
    }
}

/// The patterns of its rules.
struct Patterns {
    subscription: Subscription,
    runtime: Runtime,
}

impl Patterns {
    fn new(crowd: &Crowd) -> Self {
        let runtime = Runtime::new(crowd.agent().into());
        let subscription = crowd.graph.subscribe_to(runtime.agent().interest());
        let mut patterns = Self { subscription, runtime };
        // What Speech begins by itself has begun before the crowd moves.
        while let Some(action) = patterns.next_action(&crowd.graph) {
            if let Action::Commit(transaction) = action {
                let result = crowd.graph.commit(&transaction, Time(0));
                patterns.runtime.committed(result.as_ref(), Time(0));
            }
        }
        patterns
    }

    fn next_action(&mut self, graph: &Graph) -> Option<Action> {
        while let Some(news) = self.subscription.try_recv() {
            self.runtime.changed(&news);
        }
        self.runtime.next_action(&graph.snapshot(), Time(1))
    }
}

impl Listener for Patterns {
    fn react(&mut self, graph: &Graph) {
        // The shell asks only after it was woken, which these commits do not do; here it asks every time.
        assert!(self.next_action(graph).is_none());
    }
}

fn crowd(bench: &mut Criterion) {
    for (name, commits) in [("one of 1,000 moves", false), ("1,000 move in one commit", true)] {
        let mut group = bench.benchmark_group(name);
        for way in ["no subscriber", "every delta", "patterns"] {
            let mut crowd = Crowd::new();
            let mut listener: Box<dyn Listener> = match way {
                "every delta" => Box::new(EveryDelta::new(&crowd)),
                "patterns" => Box::new(Patterns::new(&crowd)),
                _ => Box::new(Absent),
            };
            let graph = crowd.graph.clone();
            group.bench_function(way, |b| {
                b.iter_batched(
                    || if commits { crowd.all() } else { crowd.one() },
                    |transaction| {
                        graph.commit(&transaction, Time(1)).unwrap();
                        listener.react(&graph);
                    },
                    BatchSize::PerIteration,
                );
            });
            // What Speech does about a commit that has been made.
            group.bench_function(format!("{way}, without the commit"), |b| {
                b.iter_custom(|rounds| {
                    let mut spent = std::time::Duration::ZERO;
                    for _ in 0..rounds {
                        let transaction = if commits { crowd.all() } else { crowd.one() };
                        graph.commit(&transaction, Time(1)).unwrap();
                        let started = std::time::Instant::now();
                        listener.react(&graph);
                        spent += started.elapsed();
                    }
                    spent
                });
            });
        }
        group.finish();
    }
}

criterion_group!(benches, crowd);
criterion_main!(benches);

//! One turn of the wheel, and a replan, in the Barthel test of this repository.

#![allow(missing_docs, reason = "criterion's macros define functions")]
#![allow(clippy::unwrap_used, reason = "a bench stops by panicking")]

use budget::Cancellation;
use criterion::{Criterion, criterion_group, criterion_main};
use dsr::{Edit, Graph, Time, Transaction};
use executive::{Decision, Effect, Event, GoalId, Model, Policy, Request, RequestId, Step, Wheel};
use high_to_low::Methods;
use low_to_high::{LowToHigh, Perception};
use pddl::model::{Domain, Name};
use pddl::{Source, parse_domain, parse_problem};
use std::collections::VecDeque;
use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};
use vocabulary::Tokens;

struct Barthel {
    graph: Graph,
    deltas: dsr::Deltas,
    wheel: Wheel,
    perception: Arc<Perception>,
}

fn read(path: &str) -> Source {
    let path = format!("{}/../{path}", env!("CARGO_MANIFEST_DIR"));
    Source::new(&path, std::fs::read_to_string(&path).unwrap())
}

fn domain(path: &str, imports: &[&Domain]) -> Domain {
    parse_domain(&read(path), imports).model.unwrap()
}

/// What Decision Support answers if nothing cancels it.
fn decide(model: &Arc<Model>, request: &Request) -> Decision {
    executive::decide(model, request, &Cancellation::default())
}

fn barthel() -> Barthel {
    let clarc = domain("robots/clarc/vocabulary.pddl", &[]);
    let barthel = domain("domains/barthel/domain.pddl", &[]);
    let perception = domain("domains/barthel/perception.pddl", &[&clarc, &barthel]);
    let methods = domain("domains/barthel/methods.hddl", &[&clarc]);
    let problem = |path, domain| parse_problem(&read(path), domain).model.unwrap();
    let world = problem("robots/clarc/world.pddl", &clarc);
    let nodes = problem("domains/barthel/graph.pddl", &clarc);
    let tokens = Tokens::new(&clarc).unwrap();
    let graph = tokens.populate(&[&world, &nodes], Time(0)).unwrap();
    let names: Vec<Name> =
        perception.axioms.iter().map(|a| perception.predicates[a.predicate].name.clone()).collect();
    let perception = Arc::new(Perception::new(&perception, &tokens).unwrap());
    let methods = Arc::new(Methods::new(&methods, &tokens).unwrap());
    let problem = problem("domains/barthel/problem.pddl", &barthel);
    let model = Arc::new(Model::new(barthel, problem, &names).unwrap());
    let fallback = Step { action: Name::new("fall-back"), arguments: vec![Name::new("person")] };
    let wheel = Wheel::new(model, perception.clone(), methods, Policy::new(fallback));
    let deltas = graph.subscribe_deltas();
    let mut barthel = Barthel { graph, deltas, wheel, perception };
    barthel.write("person-agent", "person", "is_with", "robot", true);
    barthel.turn(Event::Seen(barthel.graph.snapshot()));
    barthel
}

impl Barthel {
    /// An event with all that follows from it.
    fn turn(&mut self, event: Event) {
        let mut events = VecDeque::from([event]);
        while let Some(event) = events.pop_front() {
            for effect in self.wheel.step(event, Time(0)) {
                match effect {
                    Effect::Write(edits) => {
                        let mut transaction =
                            Transaction::new(self.graph.vocabulary().agent("pelea").unwrap());
                        transaction.extend(edits);
                        self.graph.commit(&transaction, Time(0)).unwrap();
                        events.extend(self.changes());
                        events.push_back(Event::Written);
                    }
                    Effect::Plan(request) => {
                        let decision = decide(self.wheel.model(), &request);
                        events.push_back(Event::Decided(request.id, decision));
                    }
                    _ => {}
                }
            }
            events.extend(self.changes());
        }
    }

    fn changes(&self) -> Vec<Event> {
        let mut events = Vec::new();
        while let Some(dsr::Event::Committed(c)) = self.deltas.try_recv() {
            events.push(Event::Changed { snapshot: c.snapshot, delta: c.delta });
        }
        events
    }

    fn write(&self, agent: &str, from: &str, label: &str, to: &str, add: bool) {
        let vocabulary = self.graph.vocabulary();
        let (from, label, to) = (from.into(), vocabulary.label(label).unwrap(), to.into());
        let edit = if add { Edit::AddEdge { from, label, to } } else { Edit::RemoveEdge { from, label, to } };
        let mut transaction = Transaction::new(vocabulary.agent(agent).unwrap());
        transaction.push(edit);
        self.graph.commit(&transaction, Time(0)).unwrap();
    }
}

/// Times the wheel alone on a token that comes and goes.
fn turns(bench: &mut Criterion, name: &str, agent: &str, from: &str, label: &str, to: &str) {
    let mut barthel = barthel();
    bench.bench_function(name, |b| {
        b.iter_custom(|rounds| {
            let mut spent = Duration::ZERO;
            for round in 0..rounds {
                barthel.write(agent, from, label, to, round % 2 == 0);
                for event in barthel.changes() {
                    let started = Instant::now();
                    black_box(barthel.wheel.step(event, Time(0)));
                    spent += started.elapsed();
                }
            }
            if rounds % 2 == 1 {
                barthel.write(agent, from, label, to, false);
                for event in barthel.changes() {
                    barthel.wheel.step(event, Time(0));
                }
            }
            spent
        });
    });
}

fn wheel(bench: &mut Criterion) {
    let token = ("speech", "first-question", "was_misheard_in", "stairs");
    turns(bench, "turn: a token that nothing mentions", token.0, token.1, token.2, token.3);
    let token = ("panel", "introduction", "was_shown_in", "stairs");
    turns(bench, "turn: a token that perception reads", token.0, token.1, token.2, token.3);
}

fn replan(bench: &mut Criterion) {
    let barthel = barthel();
    let sight = LowToHigh::new(barthel.perception.clone(), &barthel.graph.snapshot());
    let present = barthel.wheel.model().state(sight.facts());
    barthel.write("person-agent", "person", "is_with", "robot", false);
    let sight = LowToHigh::new(barthel.perception.clone(), &barthel.graph.snapshot());
    let state = barthel.wheel.model().state(sight.facts());
    let model = barthel.wheel.model();
    let mut request = Request {
        id: RequestId(0),
        state: present,
        goals: vec![GoalId(0)],
        broken: Vec::new(),
        served: vec![GoalId(0)],
        running: Vec::new(),
        barred: Vec::new(),
        expansions: 20_000,
        arrived: None,
    };
    let Decision::Plan { operators, .. } = decide(model, &request) else { panic!("there is a plan") };
    request.state = state;
    bench.bench_function("replan: the person is lost, 35 steps to go, validated", |b| {
        b.iter(|| black_box(decide(model, &request)));
    });
    request.running = operators.first().copied().into_iter().collect();
    request.broken = operators;
    bench.bench_function("the same, repaired and planned from scratch, validated", |b| {
        b.iter(|| black_box(decide(model, &request)));
    });
}

criterion_group!(benches, wheel, replan);
criterion_main!(benches);

//! What a pattern with a distance costs while frames move: a commit, and the changed matches of its one subscriber.
//! `cargo bench -p pelea-dsr --bench metrics`; figures in `BENCHMARKS.md`.
//!
//! A thousand persons stand round a robot, five metres from it, all of them on one floor. What moves is a leaf (a person,
//! the robot's camera), a frame that all distances go through (the robot), or one that none does (the floor). The change of
//! the matches is asked for in each round, whether there is one or not.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]
#![allow(clippy::unwrap_used, reason = "a bench that fails says where")]

use criterion::{Criterion, criterion_group, criterion_main};
use dsr::{
    AgentId, Comparison, Graph, Isometry3, LabelId, Nature, NodeId, PatternBuilder, Time, Transaction,
    TypeId, Vocabulary, VocabularyBuilder,
};

const PERSONS: u32 = 1_000;

struct Crowd {
    graph: Graph,
    with: LabelId,
    person: TypeId,
    robot: TypeId,
    persons: Vec<NodeId>,
}

fn place(x: f64, y: f64) -> Isometry3<f64> {
    Isometry3::new([x, y, 0.0].into(), [0.0, 0.0, 0.3].into())
}

/// Where a person stands when nothing moves.
fn round_table(at: u32) -> Isometry3<f64> {
    let angle = f64::from(at) * std::f64::consts::TAU / f64::from(PERSONS);
    place(5.0 * angle.cos(), 5.0 * angle.sin())
}

fn crowd() -> Crowd {
    let mut b = VocabularyBuilder::new();
    let frame = b.node_type("frame", None, Nature::Geometric).unwrap();
    let person = b.node_type("person", Some(frame), Nature::Symbolic).unwrap();
    let robot = b.node_type("robot", Some(frame), Nature::Symbolic).unwrap();
    let with = b.label("is_with", person, robot).unwrap();
    let graph = Graph::new(b.build());
    graph
        .edit(AgentId::DSR, Time(0), |tx| {
            tx.add_node("world", frame).add_node("floor", frame).add_node("camera", frame);
            tx.add_node("robot", robot).set_transform("world", "floor", place(0.0, 0.0));
            tx.set_transform("floor", "robot", place(0.0, 0.0));
            tx.set_transform("robot", "camera", place(0.1, 0.0));
            for at in 0..PERSONS {
                let name = format!("p{at}");
                tx.add_node(name.as_str(), person).set_transform("floor", name.as_str(), round_table(at));
                tx.add_edge(name.as_str(), with, "robot");
            }
        })
        .unwrap();
    let persons = graph.snapshot().nodes_of(person).collect();
    Crowd { graph, with, person, robot, persons }
}

type Write = fn(&mut PatternBuilder<'_>, &Crowd);

/// One frame or several move to and fro.
fn follow(c: &mut Criterion, name: &str, write: Write, moves: impl Fn(&Crowd, bool, &mut Transaction)) {
    let crowd = crowd();
    let vocabulary: &Vocabulary = &crowd.graph.vocabulary();
    let mut pattern = PatternBuilder::new(vocabulary);
    write(&mut pattern, &crowd);
    let mut matches = crowd.graph.subscribe(pattern.build().unwrap());
    while matches.try_recv().is_some() {}
    let mut round = 0_u64;
    c.bench_function(name, |bench| {
        bench.iter(|| {
            round += 1;
            let mut tx = Transaction::new(AgentId::DSR);
            moves(&crowd, round.is_multiple_of(2), &mut tx);
            crowd.graph.commit(&tx, Time(round)).unwrap();
            matches.try_recv()
        });
    });
}

/// A person nearer than a metre to a robot.
fn near(p: &mut PatternBuilder<'_>, crowd: &Crowd) {
    let (who, robot) = (p.variable("who", crowd.person), p.variable("robot", crowd.robot));
    p.distance(who, robot, Comparison::Less, 1.0);
}

/// A person who is with a robot that is further away than a metre: there are a thousand.
fn far(p: &mut PatternBuilder<'_>, crowd: &Crowd) {
    let (who, robot) = (p.variable("who", crowd.person), p.variable("robot", crowd.robot));
    p.edge(who, crowd.with, robot).distance(who, robot, Comparison::Greater, 1.0);
}

/// A robot with no person nearer than a metre.
fn alone(p: &mut PatternBuilder<'_>, crowd: &Crowd) {
    let robot = p.variable("robot", crowd.robot);
    p.without(|p| {
        let who = p.variable("who", crowd.person);
        p.distance(who, robot, Comparison::Less, 1.0);
    });
}

fn metrics(c: &mut Criterion) {
    // Within the metre and out of it.
    let walks = |crowd: &Crowd, near: bool, tx: &mut Transaction| {
        tx.set_transform("floor", crowd.persons[500], place(if near { 0.9 } else { 1.1 }, 0.0));
    };
    follow(c, "metrics/nearer than 1 m: one of 1,000 persons moves", near, walks);
    follow(c, "metrics/1,000 further than 1 m: one of them moves", far, walks);
    follow(c, "metrics/nobody nearer than 1 m: one of 1,000 persons comes and goes", alone, walks);
    follow(c, "metrics/nobody nearer than 1 m: one of 1,000 persons moves", alone, |crowd, near, tx| {
        tx.set_transform("floor", crowd.persons[700], place(if near { 4.0 } else { 4.5 }, 0.0));
    });
    follow(c, "metrics/nobody nearer than 1 m, but there is: another moves", alone, |crowd, near, tx| {
        tx.set_transform("floor", crowd.persons[500], place(0.5, 0.0));
        tx.set_transform("floor", crowd.persons[700], place(if near { 4.0 } else { 4.5 }, 0.0));
    });
    follow(c, "metrics/nearer than 1 m: ten of 1,000 persons move", near, |crowd, near, tx| {
        for &who in &crowd.persons[500..510] {
            tx.set_transform("floor", who, place(if near { 0.9 } else { 1.1 }, 0.0));
        }
    });
    let rolls = |_: &Crowd, near: bool, tx: &mut Transaction| {
        tx.set_transform("floor", "robot", place(if near { 0.1 } else { 0.0 }, 0.0));
    };
    follow(c, "metrics/nearer than 1 m: the robot moves", near, rolls);
    follow(c, "metrics/1,000 further than 1 m: the robot moves", far, rolls);
    follow(c, "metrics/nearer than 1 m: the robot's camera moves", near, |_, up, tx| {
        tx.set_transform("robot", "camera", place(if up { 0.1 } else { 0.2 }, 0.0));
    });
    follow(c, "metrics/nearer than 1 m: the floor moves with all", near, |_, up, tx| {
        tx.set_transform("world", "floor", place(if up { 0.1 } else { 0.2 }, 0.0));
    });
}

criterion_group!(benches, metrics);
criterion_main!(benches);

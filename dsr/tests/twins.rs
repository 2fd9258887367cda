//! The same history, told to a graph of which every state is held, so that each commit copies what it touches, and to one
//! where next to none is, so that each commit follows the last one in the other twin: both must be the same to the byte,
//! and so must a replay and what comes back from a journal. With leases, waits, reflexes, samples and long transactions.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::sync::Arc;

use dsr::{
    Bound, Edit, Graph, Keep, Memory, PatternBuilder, Preemption, Priority, Recording, Reflex, ReflexId,
    Settings, Time, Transaction,
};
use proptest::prelude::*;

#[derive(Debug, Clone)]
enum Deed {
    Lines(&'static str),
    Claim(usize, usize, i32),
    Await(usize, usize, i32),
    Release(usize, usize),
    Expire(usize),
    /// A reflex of one agent, with or without its lease of a resource.
    Guard(usize, Option<usize>),
    Dismiss(usize, usize),
    Sample(u64),
    /// More changes than a twin follows.
    Many(u32),
}

const AGENTS: [&str; 3] = ["speech", "watcher", "pelea"];
const RESOURCES: [&str; 2] = ["speaker", "screen"];

fn deed() -> impl Strategy<Value = Deed> {
    let lines = prop::sample::select(
        &[
            "edge clarc is speaking",
            "no-edge clarc is speaking",
            "edge carlos is_with clarc",
            "no-edge carlos is_with clarc",
            "set barthel score number 1",
            "set barthel score number 2\nclear barthel score",
            "no-node carlos",
            "node carlos person\nedge carlos is_with clarc",
            "no-node barthel",
            "node barthel test\nset barthel patient node carlos",
            "no-transform world carlos\ntransform clarc carlos 1 0 0 0 0.01",
            "sample clarc camera 1 1 0\nno-transform clarc camera\nsample clarc camera 0 2 0\nsample clarc camera 1 1 0",
            "no-transform clarc camera\nsample clarc camera 0 2 0",
        ][..],
    );
    prop_oneof![
        6 => lines.prop_map(Deed::Lines),
        3 => (0..3_usize, 0..2_usize, 0..3).prop_map(|(a, r, p)| Deed::Claim(a, r, p)),
        3 => (0..3_usize, 0..2_usize, 0..3).prop_map(|(a, r, p)| Deed::Await(a, r, p)),
        2 => (0..3_usize, 0..2_usize).prop_map(|(a, r)| Deed::Release(a, r)),
        1 => (0..3_usize).prop_map(Deed::Expire),
        4 => (0..3_usize, prop::option::of(0..2_usize)).prop_map(|(a, r)| Deed::Guard(a, r)),
        2 => (0..3_usize, 0..8_usize).prop_map(|(a, at)| Deed::Dismiss(a, at)),
        4 => (0..30_u64).prop_map(|second| Deed::Sample(second * 1_000_000_000)),
        1 => (0..3_u32).prop_map(Deed::Many),
    ]
}

fn transaction(graph: &Graph, deed: &Deed, guards: &[ReflexId]) -> Transaction {
    let vocabulary = graph.vocabulary();
    let agent = |at: usize| world::agent(&vocabulary, AGENTS[at]);
    let resource = |at: usize| vocabulary.resource(RESOURCES[at]).unwrap();
    let by = |at: usize| Transaction::new(agent(at));
    match *deed {
        Deed::Lines(lines) => world::transaction(graph, "dsr", lines),
        Deed::Claim(who, what, priority) => {
            let mut tx = by(who);
            tx.claim(resource(what), Priority(priority), Preemption::Yields);
            tx
        }
        Deed::Await(who, what, priority) => {
            let mut tx = by(who);
            let preemption = if priority == 0 { Preemption::Yields } else { Preemption::Finishes };
            tx.await_lease(resource(what), Priority(priority), preemption);
            tx
        }
        Deed::Release(who, what) => {
            let mut tx = by(who);
            tx.release(resource(what));
            tx
        }
        Deed::Expire(who) => {
            let mut tx = by(who);
            tx.push(Edit::Expire { agent: agent(who) });
            tx
        }
        Deed::Guard(who, lease) => {
            let mut pattern = PatternBuilder::new(&vocabulary);
            pattern.edge("carlos", vocabulary.label("is_with").unwrap(), "clarc");
            let keep = Bound { pattern: Arc::new(pattern.build().unwrap()), binding: Vec::new() };
            let mut tx = by(who);
            // Only `speech` and `pelea` may write it; the reflex of the other has nothing to write.
            let is = vocabulary.label("is").unwrap();
            let stop = Edit::RemoveEdge { from: "clarc".into(), label: is, to: "speaking".into() };
            tx.guard(Reflex {
                owner: agent(who),
                keep: vec![Keep::from(keep)],
                on_break: if who == 1 { Vec::new() } else { vec![stop] },
                leases: lease.map(resource).into_iter().collect(),
            });
            tx
        }
        Deed::Dismiss(who, at) => {
            let mut tx = by(who);
            if let Some(&guard) = guards.get(at) {
                tx.dismiss(guard);
            }
            tx
        }
        Deed::Sample(time) => {
            let mut tx = world::transaction(graph, "dsr", "");
            tx.sample_transform("clarc", "camera", Time(time), world::pose([1.0, 0.0, 0.0, 0.1]));
            tx
        }
        Deed::Many(of) => {
            let mut tx = world::transaction(graph, "dsr", "");
            let kind = vocabulary.node_type("part").unwrap();
            let version = graph.snapshot().version().0;
            (0..50 * of).for_each(|at| _ = tx.add_node(format!("part-{version}-{at}"), kind));
            tx
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]
    #[test]
    fn held_or_not_the_same(deeds in prop::collection::vec(deed(), 1..80)) {
        let (held, alone) = (world::ward(), world::ward());
        held.remember(usize::MAX);
        let (first, store) = (held.snapshot().export(), Memory::default());
        let small = Settings { segment_bytes: 2_000, ..Settings::default() };
        let journal = alone.journal(store.clone(), small).unwrap();
        let (mut guards, mut deltas) = (Vec::new(), Vec::new());
        for (at, deed) in deeds.iter().enumerate() {
            let time = Time(at as u64);
            let one = held.commit(&transaction(&held, deed, &guards), time);
            let two = alone.commit(&transaction(&alone, deed, &guards), time);
            prop_assert_eq!(one.as_ref().map(|c| (&c.delta, &c.guards)), two.as_ref().map(|c| (&c.delta, &c.guards)));
            prop_assert_eq!(world::bytes(&held), world::bytes(&alone), "{:?}", deed);
            if let Ok(commit) = one {
                guards.extend(commit.guards);
                if !(commit.delta.changes.is_empty() && commit.delta.reflexes.is_empty()) {
                    deltas.push((*commit.delta).clone());
                }
            }
            // A state that a graph made is one that it takes back.
            let restored = Graph::restore(alone.vocabulary(), &alone.snapshot().export()).unwrap();
            prop_assert_eq!(world::bytes(&restored), world::bytes(&alone));
        }
        let replayed = Graph::replay(held.vocabulary(), &first, &deltas).unwrap();
        prop_assert_eq!(world::bytes(&replayed), world::bytes(&alone));
        let last = alone.snapshot();
        journal.close().unwrap();
        let read = Recording::read(store.segments()).unwrap().at(last.version()).unwrap();
        prop_assert_eq!(serde_json::to_string(&read.export()).unwrap(), world::bytes(&alone));
    }
}

//! What a commit, a look and a wake cost. `cargo bench -p pelea-dsr`; figures in `BENCHMARKS.md`.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]
#![allow(clippy::unwrap_used, reason = "a bench that fails says where")]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use dsr::{AgentId, PatternBuilder, Time, Transaction};

mod ward;

use ward::{three_edits, ward};

fn transactions(c: &mut Criterion) {
    for count in [1_000, 10_000, 100_000, 1_000_000] {
        let ward = ward(count);
        let mut round = 0_u64;
        c.bench_function(&format!("transaction/3 edits, {count} nodes"), |bench| {
            bench.iter(|| {
                round += 1;
                ward.graph.commit(&three_edits(&ward, round), Time(round)).unwrap()
            });
        });
        let mut held = ward.graph.snapshot();
        c.bench_function(&format!("transaction/3 edits, {count} nodes, the state before held"), |bench| {
            bench.iter(|| {
                round += 1;
                held = ward.graph.commit(&three_edits(&ward, round), Time(round)).unwrap().snapshot;
            });
        });
        drop(held);
        let now = ward.graph.snapshot();
        c.bench_function(&format!("attribute by id, at random, {count} nodes"), |bench| {
            bench.iter(|| {
                round += 1;
                let at = usize::try_from(round.wrapping_mul(2_654_435_761)).unwrap() % ward.nodes.len();
                now.attribute(black_box(ward.nodes[at]), ward.score)
            });
        });
    }
    let ward = ward(10_000);
    let refused = {
        let mut tx = three_edits(&ward, 1);
        tx.add_edge(ward.nodes[0], ward.label, ward.nodes[0]);
        tx
    };
    c.bench_function("transaction/refused at its 4th edit", |bench| {
        bench.iter(|| ward.graph.commit(&refused, Time(1)).unwrap_err());
    });
}

fn looks(c: &mut Criterion) {
    let ward = ward(10_000);
    c.bench_function("snapshot", |bench| bench.iter(|| ward.graph.snapshot()));
    let now = ward.graph.snapshot();
    for depth in [1, 10, 50] {
        let (root, leaf) = (ward.nodes[0], ward.nodes[depth]);
        c.bench_function(&format!("chain/depth {depth}"), |bench| {
            bench.iter(|| now.transform(black_box(root), black_box(leaf)).unwrap());
        });
    }
    c.bench_function("attribute by id", |bench| {
        bench.iter(|| now.attribute(black_box(ward.nodes[5_000]), ward.score));
    });
    c.bench_function("node by name", |bench| bench.iter(|| now.node(black_box("n5000"))));
}

fn subscriptions(c: &mut Criterion) {
    let ward = ward(10_000);
    let dictionary = ward.graph.dictionary();
    let mut pattern = PatternBuilder::new(&dictionary);
    let next = pattern.variable("next", dictionary.node_type("place").unwrap());
    pattern.edge("n0", ward.label, next).edge(next, ward.label, "n9");
    let pattern = Arc::new(pattern.build().unwrap());
    let now = ward.graph.snapshot();
    c.bench_function("pattern/3 nodes, one named", |bench| bench.iter(|| pattern.holds(&now)));

    // Commit, then the subscriber's match change, on one thread: the cost without any scheduler.
    let mut matches = ward.graph.subscribe(Arc::clone(&pattern));
    let mut round = 0_u64;
    c.bench_function("wake/commit to match change, same thread", |bench| {
        bench.iter(|| {
            round += 1;
            let (a, b) = (ward.nodes[5], ward.nodes[9]);
            let mut tx = Transaction::new(AgentId::DSR);
            if round.is_multiple_of(2) {
                tx.remove_edge(a, ward.label, b)
            } else {
                tx.add_edge(a, ward.label, b)
            };
            tx.add_edge(ward.nodes[0], ward.label, a);
            ward.graph.commit(&tx, Time(round)).unwrap();
            matches.try_recv()
        });
    });
    drop(matches);

    // A thousand patterns of three nodes, two of them named, of which one matches what changes.
    let place = dictionary.node_type("place").unwrap();
    for count in [1, 1_000] {
        let mut subscribers: Vec<_> = (0..count)
            .map(|at| {
                let mut pattern = PatternBuilder::new(&dictionary);
                let between = pattern.variable("between", place);
                let (start, end) = (format!("n{}", 5 + 8 * at), format!("n{}", 10 + 8 * at));
                pattern.edge(start.as_str(), ward.label, between).edge(between, ward.label, end.as_str());
                let mut matches = ward.graph.subscribe(pattern.build().unwrap());
                while matches.try_recv().is_some() {}
                matches
            })
            .collect();
        let mut round = 0_u64;
        c.bench_function(&format!("patterns/{count} subscribed, one concerned, commit and match"), |bench| {
            bench.iter(|| {
                round += 1;
                let (a, b) = (ward.nodes[5], ward.nodes[9]);
                let mut tx = Transaction::new(AgentId::DSR);
                if round.is_multiple_of(2) {
                    tx.remove_edge(a, ward.label, b)
                } else {
                    tx.add_edge(a, ward.label, b)
                };
                ward.graph.commit(&tx, Time(round)).unwrap();
                subscribers[0].try_recv()
            });
        });
    }
    // One pattern with ten thousand matches: the change is one of them.
    let mut open = PatternBuilder::new(&dictionary);
    let (a, b, d) = (open.variable("a", place), open.variable("b", place), open.variable("d", place));
    open.edge(a, ward.label, b).edge(b, ward.label, d);
    open.without(|p| _ = p.edge(a, ward.label, d));
    let mut everywhere = ward.graph.subscribe(open.build().unwrap());
    while everywhere.try_recv().is_some() {}
    let mut round = 0_u64;
    c.bench_function("patterns/one with 10,000 matches, commit and match", |bench| {
        bench.iter(|| {
            round += 1;
            let (a, b) = (ward.nodes[50], ward.nodes[90]);
            let mut tx = Transaction::new(AgentId::DSR);
            if round.is_multiple_of(2) {
                tx.remove_edge(a, ward.label, b)
            } else {
                tx.add_edge(a, ward.label, b)
            };
            ward.graph.commit(&tx, Time(round)).unwrap();
            everywhere.try_recv()
        });
    });
    drop(everywhere);

    // The same with the subscriber parked on another thread, which answers over a channel.
    let mut matches = ward.graph.subscribe(pattern);
    let (told, heard) = std::sync::mpsc::sync_channel(1);
    let graph = ward.graph.clone();
    let subscriber = std::thread::spawn(move || {
        while let Some(change) = matches.recv() {
            if told.send(change.version).is_err() {
                return;
            }
        }
    });
    while heard.try_recv().is_ok() {}
    let mut add = false;
    c.bench_function("wake/commit to parked thread and back", |bench| {
        bench.iter(|| {
            let now = graph.snapshot();
            let (a, b) = (ward.nodes[5], ward.nodes[9]);
            add = !now.has_edge(a, ward.label, b);
            let mut tx = Transaction::new(AgentId::DSR);
            if add {
                tx.add_edge(a, ward.label, b)
            } else {
                tx.remove_edge(a, ward.label, b)
            };
            let commit = graph.commit(&tx, Time(1)).unwrap();
            while heard.recv().unwrap() < commit.version {}
        });
    });
    drop(heard);
    drop((graph, ward));
    drop(subscriber);
}

criterion_group!(benches, transactions, looks, subscriptions);
criterion_main!(benches);

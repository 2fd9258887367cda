//! What a commit, a look and a wake cost. `cargo bench -p pelea-dsr`; figures in `BENCHMARKS.md`.
#![allow(missing_docs, reason = "criterion's macros write undocumented functions")]
#![allow(clippy::unwrap_used, reason = "a bench that fails says where")]

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use dsr::{AgentId, Comparison, Pattern, PatternBuilder, Time};

mod ward;

use ward::{Ward, three_edits, toggle, ward};

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
    let vocabulary = ward.graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    let next = pattern.variable("next", vocabulary.node_type("place").unwrap());
    pattern.edge("n0", ward.label, next).edge(next, ward.label, "n9");
    let pattern = Arc::new(pattern.build().unwrap());
    let now = ward.graph.snapshot();
    c.bench_function("pattern/3 nodes, one named", |bench| bench.iter(|| pattern.holds(&now)));

    // Commit, then the subscriber's match change, on one thread: the cost without any scheduler.
    let mut matches = ward.graph.subscribe(pattern);
    let mut round = 0_u64;
    c.bench_function("wake/commit to match change, same thread", |bench| {
        bench.iter(|| {
            round += 1;
            let mut tx = toggle(&ward, (5, 9), round);
            tx.add_edge(ward.nodes[0], ward.label, ward.nodes[5]);
            ward.graph.commit(&tx, Time(round)).unwrap();
            matches.try_recv()
        });
    });
    drop(matches);

    let place = vocabulary.node_type("place").unwrap();
    // Patterns of three nodes, of which one matches what changes: two of its nodes named, or none of them.
    let named = |at: usize| {
        let mut pattern = PatternBuilder::new(&vocabulary);
        let between = pattern.variable("between", place);
        let (start, end) = (format!("n{}", 5 + 8 * at), format!("n{}", 10 + 8 * at));
        pattern.edge(start.as_str(), ward.label, between).edge(between, ward.label, end.as_str());
        pattern.build().unwrap()
    };
    let nameless = |at: usize| {
        let mut pattern = PatternBuilder::new(&vocabulary);
        let [a, b, d] = ["a", "b", "d"].map(|name| pattern.variable(name, place));
        pattern.edge(a, ward.label, b).edge(b, ward.label, d);
        #[expect(clippy::cast_precision_loss, reason = "small")]
        pattern.guard(b, ward.score, Comparison::Equal, 1.0 + at as f64);
        pattern.build().unwrap()
    };
    set_score(&ward, 9, 1.0);
    for count in [1, 1_000] {
        follow(c, &ward, &format!("patterns/{count} with names, one concerned"), (0..count).map(named));
        follow(c, &ward, &format!("patterns/{count} without names, one concerned"), (0..count).map(nameless));
    }
    // One pattern with ten thousand matches: the change is one of them.
    let mut open = PatternBuilder::new(&vocabulary);
    let [a, b, d] = ["a", "b", "d"].map(|name| open.variable(name, place));
    open.edge(a, ward.label, b).edge(b, ward.label, d);
    open.without(|p| _ = p.edge(a, ward.label, d));
    follow(c, &ward, "patterns/one with 10,000 matches", std::iter::once(open.build().unwrap()));
}

fn set_score(ward: &Ward, at: usize, score: f64) {
    ward.graph
        .edit(AgentId::DSR, Time(0), |tx| _ = tx.set_attribute(ward.nodes[at], ward.score, score))
        .unwrap();
}

/// Commits an edge that concerns the first of these patterns, and takes the change of its matches.
fn follow(c: &mut Criterion, ward: &Ward, name: &str, patterns: impl Iterator<Item = Pattern>) {
    let mut subscribers: Vec<_> = patterns.map(|pattern| ward.graph.subscribe(pattern)).collect();
    subscribers.iter_mut().for_each(|matches| while matches.try_recv().is_some() {});
    let mut round = 0_u64;
    c.bench_function(&format!("{name}, commit and match"), |bench| {
        bench.iter(|| {
            round += 1;
            ward.graph.commit(&toggle(ward, (5, 9), round), Time(round)).unwrap();
            subscribers[0].try_recv()
        });
    });
}

criterion_group!(benches, transactions, looks, subscriptions);
criterion_main!(benches);

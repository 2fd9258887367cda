//! What a subscriber asks for beside patterns, and what one queue for all of it reports.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use dsr::{Edit, Graph, Interest, Mentions, PatternBuilder, Reflex, Subscription, Time, Transaction};
use world::{agent, commit, ward};

/// A subscription, and how often it was woken.
fn subscribe(graph: &Graph, interest: Interest) -> (Subscription, Arc<AtomicUsize>) {
    let mut subscription = graph.subscribe_to(interest);
    let start = subscription.try_recv().expect("the start is reported even if nothing matches");
    assert!(start.deltas.is_empty());
    let woken = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&woken);
    subscription.on_wake(move || _ = count.fetch_add(1, Ordering::SeqCst));
    (subscription, woken)
}

fn versions(subscription: &mut Subscription) -> Vec<u64> {
    std::iter::from_fn(|| subscription.try_recv()).map(|news| news.snapshot.version().0).collect()
}

#[test]
fn tokens_are_reported_whatever_is_at_their_ends() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let mut tokens = Mentions::default();
    tokens.add_label(vocabulary.label("is").unwrap());
    tokens.add_attribute(vocabulary.attribute("score").unwrap());
    let mut interest = Interest::default();
    interest.add_tokens(&tokens);
    let (mut subscription, woken) = subscribe(&graph, interest);
    let first = graph.snapshot().version().0;
    commit(&graph, "dsr", "edge clarc is speaking").unwrap();
    commit(&graph, "dsr", "edge barthel is_in bathing").unwrap();
    commit(&graph, "dsr", "set barthel score number 5").unwrap();
    commit(&graph, "dsr", "no-edge carlos is_with clarc").unwrap();
    commit(&graph, "dsr", "set barthel score number 6").unwrap();
    assert_eq!(versions(&mut subscription), [first + 1, first + 3, first + 5]);
    assert_eq!(woken.load(Ordering::SeqCst), 3);
}

#[test]
fn transforms_are_tokens() {
    let graph = ward();
    let mut tokens = Mentions::default();
    tokens.add_transforms();
    let mut interest = Interest::default();
    interest.add_tokens(&tokens);
    let (mut subscription, _) = subscribe(&graph, interest);
    commit(&graph, "dsr", "edge clarc is speaking").unwrap();
    assert_eq!(versions(&mut subscription), [0_u64; 0]);
    let moved = commit(&graph, "dsr", "transform world carlos 5 0 0 0").unwrap();
    assert_eq!(versions(&mut subscription), [moved.version.0]);
}

#[test]
fn an_agent_hears_of_its_own_commits_and_reflexes_only() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let speech = agent(&vocabulary, "speech");
    let mut writes = Interest::default();
    writes.follow_commits(speech);
    let mut fires = Interest::default();
    fires.follow_reflexes(speech);
    let mut other = Interest::default();
    other.follow_reflexes(agent(&vocabulary, "watcher"));
    let (mut writes, _) = subscribe(&graph, writes);
    let (mut fires, _) = subscribe(&graph, fires);
    let (mut other, woken) = subscribe(&graph, other);

    let is = vocabulary.label("is").unwrap();
    let mut keep = PatternBuilder::new(&vocabulary);
    keep.edge("carlos", vocabulary.label("is_with").unwrap(), "clarc");
    let keep = dsr::Bound { pattern: Arc::new(keep.build().unwrap()), binding: Vec::new() };
    let mut tx = Transaction::new(speech);
    tx.add_edge("clarc", is, "speaking").guard(Reflex {
        owner: speech,
        keep: vec![keep.into()],
        on_break: vec![Edit::RemoveEdge { from: "clarc".into(), label: is, to: "speaking".into() }],
        leases: Vec::new(),
    });
    let started = graph.commit(&tx, Time(9)).unwrap();
    let lost = commit(&graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    assert_eq!(lost.delta.reflexes, started.guards);
    assert_eq!(versions(&mut writes), [started.version.0]);
    assert_eq!(versions(&mut fires), [lost.version.0]);
    assert_eq!(versions(&mut other), [0_u64; 0]);
    assert_eq!(woken.load(Ordering::SeqCst), 0);
}

#[test]
fn several_patterns_come_from_one_queue_in_the_order_of_versions() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let mut interest = Interest::default();
    let edge = |from: &str, label: &str, to: &str| {
        let mut pattern = PatternBuilder::new(&vocabulary);
        pattern.edge(from, vocabulary.label(label).unwrap(), to);
        pattern.build().unwrap()
    };
    let speaks = interest.add(edge("clarc", "is", "speaking"));
    let with = interest.add(edge("carlos", "is_with", "clarc"));
    let mut subscription = graph.subscribe_to_with(interest, NonZeroUsize::new(2).unwrap());
    let start = subscription.try_recv().unwrap();
    assert_eq!(start.matches.iter().map(|changed| changed.pattern).collect::<Vec<_>>(), [with]);

    commit(&graph, "dsr", "edge clarc is speaking").unwrap();
    commit(&graph, "dsr", "no-edge carlos is_with clarc").unwrap();
    let (first, second) = (subscription.try_recv().unwrap(), subscription.try_recv().unwrap());
    assert_eq!((first.matches[0].pattern, first.matches[0].appeared.len()), (speaks, 1));
    assert_eq!((second.matches[0].pattern, second.matches[0].disappeared.len()), (with, 1));
    assert!(first.snapshot.version() < second.snapshot.version());

    // More than the queue holds: one news, of the newest state.
    for line in ["no-edge clarc is speaking", "edge carlos is_with clarc", "edge clarc is speaking"] {
        commit(&graph, "dsr", line).unwrap();
    }
    let late = subscription.try_recv().unwrap();
    assert_eq!((late.missed, late.deltas.len()), (3, 0));
    assert_eq!(late.matches.len(), 1);
    assert_eq!((subscription.held(speaks).len(), subscription.held(with).len()), (1, 1));
}

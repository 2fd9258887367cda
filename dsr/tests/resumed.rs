//! After a crash: the reflexes that were registered fire when their owners expire, as they would have without a crash.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use dsr::{
    Edit, Graph, Memory, Preemption, Priority, Recording, Reflex, ReflexId, Settings, Time, Transaction,
    Version,
};
use world::{agent, bytes, commit, vocabulary, ward};

fn is_speaking(graph: &Graph) -> (Edit, Edit) {
    let is = graph.vocabulary().label("is").unwrap();
    let [from, to] = ["clarc".into(), "speaking".into()];
    let finished = graph.vocabulary().label("finished").unwrap();
    let off = Edit::RemoveEdge { from, label: is, to };
    (off, Edit::AddEdge { from: "clarc".into(), label: finished, to: "speaking".into() })
}

/// Speech begins to speak; when it dies, clarc has finished speaking.
fn speak(graph: &Graph) -> ReflexId {
    let speech = agent(&graph.vocabulary(), "speech");
    let speaker = graph.vocabulary().resource("speaker").unwrap();
    let (off, finished) = is_speaking(graph);
    let is = graph.vocabulary().label("is").unwrap();
    let mut tx = Transaction::new(speech);
    tx.claim(speaker, Priority(1), Preemption::Yields).add_edge("clarc", is, "speaking");
    tx.guard(Reflex {
        owner: speech,
        keep: Vec::new(),
        on_break: vec![off, finished],
        leases: vec![speaker],
    });
    graph.commit(&tx, Time(9)).unwrap().guards[0]
}

/// A reflex that writes nothing now, in a commit without a version.
fn watch(graph: &Graph) -> ReflexId {
    let watcher = agent(&graph.vocabulary(), "watcher");
    let is_with = graph.vocabulary().label("is_with").unwrap();
    let lose = Edit::RemoveEdge { from: "carlos".into(), label: is_with, to: "clarc".into() };
    let mut tx = Transaction::new(watcher);
    tx.guard(Reflex { owner: watcher, keep: Vec::new(), on_break: vec![lose], leases: Vec::new() });
    let before = graph.snapshot().version();
    let commit = graph.commit(&tx, Time(9)).unwrap();
    assert_eq!(commit.version, before);
    commit.guards[0]
}

fn dismiss(graph: &Graph, owner: &str, reflex: ReflexId) {
    let mut tx = Transaction::new(agent(&graph.vocabulary(), owner));
    tx.dismiss(reflex);
    graph.commit(&tx, Time(10)).unwrap();
}

/// Everybody dies, in the order of the vocabulary.
fn expire_all(graph: &Graph) {
    for name in ["speech", "watcher"] {
        graph.expire(agent(&vocabulary(), name), Time(20)).unwrap();
    }
}

/// What everybody's death leaves, with a crash before it and without; for small segments and large ones.
fn same_with_and_without_a_crash(history: impl Fn(&Graph)) {
    for segment_bytes in [1, 1 << 20] {
        let graph = ward();
        let memory = Memory::default();
        let settings = Settings { segment_bytes, ..Settings::default() };
        let journal = graph.journal(memory.clone(), settings).unwrap();
        history(&graph);
        journal.close().unwrap();
        let recording = Recording::read(memory.segments()).unwrap();
        assert_eq!(recording.damage(), &[]);
        let resumed = recording.resume().unwrap();
        assert_eq!(bytes(&resumed), bytes(&graph));
        expire_all(&graph);
        expire_all(&resumed);
        assert_eq!(bytes(&resumed), bytes(&graph));
        let speaker = resumed.vocabulary().resource("speaker").unwrap();
        assert!(resumed.snapshot().lease(speaker).is_none());
    }
}

#[test]
fn a_reflex_outlives_the_process() {
    same_with_and_without_a_crash(|graph| _ = speak(graph));
}

#[test]
fn so_does_one_whose_commit_made_no_version() {
    same_with_and_without_a_crash(|graph| _ = watch(graph));
    same_with_and_without_a_crash(|graph| {
        watch(graph);
        speak(graph);
        watch(graph);
    });
}

#[test]
fn one_that_was_dismissed_or_has_fired_does_not() {
    same_with_and_without_a_crash(|graph| dismiss(graph, "speech", speak(graph)));
    same_with_and_without_a_crash(|graph| dismiss(graph, "watcher", watch(graph)));
    same_with_and_without_a_crash(|graph| {
        speak(graph);
        graph.expire(agent(&graph.vocabulary(), "speech"), Time(10)).unwrap();
        commit(graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    });
}

#[test]
fn a_graph_that_goes_on_journals_the_reflexes_that_it_began_with() {
    same_with_and_without_a_crash(|graph| {
        speak(graph);
        let again = Memory::default();
        graph.journal(again.clone(), Settings::default()).unwrap().close().unwrap();
        let resumed = Recording::read(again.segments()).unwrap().resume().unwrap();
        let twice = Memory::default();
        resumed.journal(twice.clone(), Settings::default()).unwrap().close().unwrap();
        let resumed = Recording::read(twice.segments()).unwrap().resume().unwrap();
        expire_all(&resumed);
        let is = resumed.vocabulary().label("is").unwrap();
        let snapshot = resumed.snapshot();
        let [clarc, speaking] = ["clarc", "speaking"].map(|name| snapshot.node(name).unwrap());
        assert!(!snapshot.has_edge(clarc, is, speaking));
    });
}

#[test]
fn a_graph_resumes_at_any_version() {
    let graph = ward();
    let memory = Memory::default();
    let journal = graph.journal(memory.clone(), Settings::default()).unwrap();
    let before = bytes(&graph);
    let speech = speak(&graph);
    let during = graph.snapshot().version();
    dismiss(&graph, "speech", speech);
    journal.close().unwrap();
    let recording = Recording::read(memory.segments()).unwrap();
    let first = recording.resume_at(recording.first().0).unwrap();
    assert_eq!(bytes(&first), before);
    let fires = |version: Version| {
        let graph = recording.resume_at(version).unwrap();
        let commit = graph.expire(agent(&graph.vocabulary(), "speech"), Time(20)).unwrap();
        commit.delta.reflexes.len()
    };
    assert_eq!([fires(recording.first().0), fires(during), fires(recording.last().0)], [0, 1, 0]);
    assert!(recording.resume_at(Version(99)).is_err());
}

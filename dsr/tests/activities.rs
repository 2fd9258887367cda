//! Leases and reflexes: one activity runs, something happens, and all of it is in one commit.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::sync::Arc;

use dsr::{
    Bound, Edit, Keep, LabelId, NodeRef, Pattern, PatternBuilder, Preemption, Priority, Reflex, Time,
    Transaction, TransactionError,
};
use expect_test::expect;
use world::{agent, commit, vocabulary, ward};

/// "The person is with the robot."
fn accompanied(graph: &dsr::Graph) -> Bound {
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    let person = pattern.variable("person", vocabulary.node_type("person").unwrap());
    pattern.edge(person, vocabulary.label("is_with").unwrap(), "clarc");
    let carlos = graph.snapshot().node("carlos").unwrap();
    Bound { pattern: Arc::new(pattern.build().unwrap()), binding: vec![(person, carlos)] }
}

/// Speech begins to speak and leaves the reflex that stops it when the person is lost.
fn speak(graph: &dsr::Graph, priority: i32) -> Result<dsr::Commit, TransactionError> {
    let vocabulary = graph.vocabulary();
    let speech = agent(&vocabulary, "speech");
    let (is, finished) = (vocabulary.label("is").unwrap(), vocabulary.label("finished").unwrap());
    let speaker = vocabulary.resource("speaker").unwrap();
    let mut tx = Transaction::new(speech);
    tx.claim(speaker, Priority(priority), Preemption::Yields).add_edge("clarc", is, "speaking").guard(
        Reflex {
            owner: speech,
            keep: vec![Keep::from(accompanied(graph))],
            on_break: vec![
                remove("clarc", is, "speaking"),
                Edit::AddEdge { from: "clarc".into(), label: finished, to: "speaking".into() },
            ],
            leases: vec![speaker],
        },
    );
    graph.commit(&tx, Time(9))
}

fn remove(from: &str, label: LabelId, to: &str) -> Edit {
    Edit::RemoveEdge { from: NodeRef::from(from), label, to: NodeRef::from(to) }
}

#[test]
fn speech_stops_in_the_commit_that_loses_the_person() {
    let graph = ward();
    let started = speak(&graph, 1).unwrap();
    let lost = commit(&graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    assert_eq!(lost.version.0, started.version.0 + 1);
    assert_eq!(lost.delta.reflexes, started.guards);
    expect![[r#"
        no longer: speech holds speaker: priority 1
        no longer: speech holds speaker: yields true
        no longer: speech holds speaker: claim 2
        no longer: speech holds speaker
        no longer: clarc is speaking
        no longer: carlos is with clarc
        clarc finished speaking"#]]
    .assert_eq(&lost.delta.sentences(&lost.snapshot).join("\n"));

    // The activity's own end comes too late and changes nothing.
    let before = world::bytes(&graph);
    let mut end = Transaction::new(agent(&graph.vocabulary(), "speech"));
    end.dismiss(started.guards[0]).add_edge("clarc", graph.vocabulary().label("is").unwrap(), "speaking");
    let gone = TransactionError::ReflexGone { reflex: started.guards[0] };
    assert_eq!(graph.commit(&end, Time(10)).unwrap_err(), gone);
    assert_eq!(world::bytes(&graph), before);
}

#[test]
fn removing_the_person_fires_too_and_edits_on_the_removed_node_are_left_out() {
    let graph = ward();
    let started = speak(&graph, 1).unwrap();
    let lost = commit(&graph, "watcher", "no-node carlos").unwrap();
    assert_eq!(lost.delta.reflexes, started.guards);
    assert!(lost.snapshot.sentences().contains(&"clarc finished speaking".to_owned()));
}

#[test]
fn an_activity_that_ends_gives_its_leases_back_and_its_reflex_is_gone() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let started = speak(&graph, 1).unwrap();
    let mut end = Transaction::new(agent(&vocabulary, "speech"));
    end.dismiss(started.guards[0]).remove_edge("clarc", vocabulary.label("is").unwrap(), "speaking");
    let ended = graph.commit(&end, Time(10)).unwrap();
    assert_eq!(ended.snapshot.lease(vocabulary.resource("speaker").unwrap()), None);
    let lost = commit(&graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    assert_eq!(lost.delta.reflexes, []);
}

#[test]
fn a_higher_claim_of_another_agent_or_of_the_same_one_breaks_the_activity() {
    for claimant in ["pelea", "speech"] {
        let graph = ward();
        let started = speak(&graph, 1).unwrap();
        let refused = commit(&graph, claimant, "claim speaker 1 yields").unwrap_err();
        assert_eq!(refused.to_string(), "'speech' holds 'speaker' with priority 1");
        let taken = commit(&graph, claimant, "claim speaker 2 finishes").unwrap();
        assert_eq!(taken.delta.reflexes, started.guards, "{claimant}");
        let lease = taken.snapshot.lease(graph.vocabulary().resource("speaker").unwrap()).unwrap();
        assert_eq!((lease.holder, lease.priority), (agent(&graph.vocabulary(), claimant), Priority(2)));
        assert!(!taken.snapshot.sentences().contains(&"clarc is speaking".to_owned()));
        // This holder finishes first, whatever the claim.
        assert!(commit(&graph, "watcher", "claim speaker 99 yields").is_err());
    }
}

#[test]
fn a_dead_agent_is_buried_with_its_leases_and_reflexes() {
    let graph = ward();
    let started = speak(&graph, 1).unwrap();
    commit(&graph, "speech", "claim screen 1 yields").unwrap();
    let buried = graph.expire(agent(&graph.vocabulary(), "speech"), Time(10)).unwrap();
    assert_eq!(buried.delta.reflexes, started.guards);
    assert!(buried.snapshot.sentences().iter().all(|sentence| !sentence.contains("holds")));
}

#[test]
fn a_reflex_is_refused_when_its_condition_its_lease_or_its_edits_fail_at_once() {
    let graph = ward();
    let vocabulary = vocabulary();
    commit(&graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    assert!(matches!(speak(&graph, 1), Err(TransactionError::KeepBroken { keep: 0, .. })));
    assert!(
        matches!(speak(&graph, 1), Err(TransactionError::KeepBroken { .. })),
        "and no lease is left behind"
    );

    let speech = agent(&vocabulary, "speech");
    let guard = |on_break, leases| {
        let mut tx = Transaction::new(speech);
        tx.guard(Reflex { owner: speech, keep: Vec::new(), on_break, leases });
        graph.commit(&tx, Time(10)).unwrap_err().to_string()
    };
    let speaker = vocabulary.resource("speaker").unwrap();
    assert_eq!(guard(Vec::new(), vec![speaker]), "'speech' does not hold 'speaker'");
    let is_with = vocabulary.label("is_with").unwrap();
    expect![
        "a reflex of 'speech' could not fire: 'speech' may not write label 'is_with' at 'carlos', 'clarc'"
    ]
    .assert_eq(&guard(vec![remove("carlos", is_with, "clarc")], Vec::new()));
}

#[test]
fn reflexes_break_one_another_to_the_end() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let is = vocabulary.label("is").unwrap();
    let pelea = agent(&vocabulary, "pelea");
    speak(&graph, 1).unwrap();
    // PELEA listens as long as the robot speaks: broken by what the first reflex writes.
    let mut pattern = PatternBuilder::new(&vocabulary);
    pattern.edge("clarc", is, "speaking");
    let speaking: Pattern = pattern.build().unwrap();
    let mut tx = Transaction::new(pelea);
    tx.add_edge("clarc", is, "listening").guard(Reflex {
        owner: pelea,
        keep: vec![Bound { pattern: Arc::new(speaking), binding: Vec::new() }.into()],
        on_break: vec![remove("clarc", is, "listening")],
        leases: Vec::new(),
    });
    graph.commit(&tx, Time(10)).unwrap();
    let lost = commit(&graph, "watcher", "no-edge carlos is_with clarc").unwrap();
    assert_eq!(lost.delta.reflexes.len(), 2);
    expect![[r#"
        clarc finished speaking
        barthel is in feeding"#]]
    .assert_eq(&lost.snapshot.sentences().join("\n"));
}

/// It would fire when its owner is dead, and the dead hold nothing.
#[test]
fn a_reflex_takes_no_lease() {
    let graph = ward();
    let vocabulary = graph.vocabulary();
    let (speech, speaker) = (agent(&vocabulary, "speech"), vocabulary.resource("speaker").unwrap());
    let (priority, preemption) = (Priority(1), Preemption::Yields);
    for edit in [
        Edit::Claim { resource: speaker, priority, preemption },
        Edit::Await { resource: speaker, priority, preemption },
    ] {
        let mut tx = Transaction::new(speech);
        tx.guard(Reflex { owner: speech, keep: Vec::new(), on_break: vec![edit], leases: Vec::new() });
        let refused = TransactionError::ReflexClaims { owner: "speech".into(), resource: "speaker".into() };
        assert_eq!(graph.commit(&tx, Time(9)).unwrap_err(), refused);
    }
}

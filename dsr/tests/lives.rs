//! An agent that was declared dead can no longer write, and its successor can.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use dsr::{AgentId, Edit, Epoch, Graph, Time, Transaction, TransactionError};
use world::ward;

fn speech(graph: &Graph) -> AgentId {
    graph.vocabulary().agent("speech").unwrap()
}

/// Speech says that the robot speaks, in this life.
fn speak(graph: &Graph, epoch: Epoch) -> Result<(), TransactionError> {
    let is = graph.vocabulary().label("is").unwrap();
    let mut transaction = Transaction::new(speech(graph));
    transaction.add_edge("clarc", is, "speaking").in_epoch(speech(graph), epoch);
    graph.commit(&transaction, Time(10)).map(|_| ())
}

#[test]
fn what_an_expired_agent_writes_is_refused() {
    let graph = ward();
    let life = graph.attend(speech(&graph));
    speak(&graph, life.epoch()).unwrap();
    graph.expire(speech(&graph), Time(10)).unwrap();
    let version = graph.snapshot().version();
    let refused = speak(&graph, life.epoch()).unwrap_err();
    assert_eq!(refused.to_string(), "this life of 'speech' is over");
    assert_eq!(graph.snapshot().version(), version);
}

#[test]
fn a_successor_writes_and_the_end_of_its_predecessor_does_not_touch_it() {
    let graph = ward();
    let first = graph.attend(speech(&graph));
    let second = graph.attend(speech(&graph));
    assert!(first.epoch() < second.epoch());
    assert!(matches!(speak(&graph, first.epoch()), Err(TransactionError::Fenced { .. })));
    world::commit(&graph, "speech", "claim speaker 1 yields").unwrap();
    drop(first);
    speak(&graph, second.epoch()).unwrap();
    let speaker = graph.vocabulary().resource("speaker").unwrap();
    assert!(graph.snapshot().lease(speaker).is_some());
    drop(second);
    assert!(graph.snapshot().lease(speaker).is_none());
}

#[test]
fn the_end_of_a_life_is_one_commit_with_what_it_leaves_behind() {
    let graph = ward();
    world::commit(&graph, "speech", "claim speaker 1 yields").unwrap();
    let is = graph.vocabulary().label("is").unwrap();
    let mut life = graph.attend(speech(&graph));
    life.leave_behind([Edit::AddEdge { from: "clarc".into(), label: is, to: "speaking".into() }]);
    let deltas = graph.subscribe_deltas();
    drop(life);
    let Some(dsr::Event::Committed(end)) = deltas.try_recv() else { panic!("no commit") };
    assert!(deltas.try_recv().is_none());
    let lines = end.delta.sentences(&end.snapshot);
    assert!(lines.contains(&"clarc is speaking".to_owned()), "{lines:?}");
    assert!(lines.contains(&"no longer: speech holds speaker".to_owned()), "{lines:?}");
}

#[test]
fn a_life_ends_also_if_what_it_leaves_behind_is_no_token() {
    let graph = ward();
    world::commit(&graph, "speech", "claim speaker 1 yields").unwrap();
    let mut life = graph.attend(speech(&graph));
    life.leave_behind([Edit::RemoveNode { node: "nothing of the kind".into() }]);
    drop(life);
    let speaker = graph.vocabulary().resource("speaker").unwrap();
    assert!(graph.snapshot().lease(speaker).is_none());
}

#[test]
fn a_transaction_without_a_life_is_as_before() {
    let graph = ward();
    graph.expire(speech(&graph), Time(10)).unwrap();
    world::commit(&graph, "speech", "edge clarc is speaking").unwrap();
}

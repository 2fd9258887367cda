//! Many threads on one graph: no update is lost, commits are delivered in order, sleeping subscribers are woken.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use dsr::{AgentId, Comparison, Event, Graph, NodeRef, PatternBuilder, Time};

#[test]
fn no_increment_is_lost_and_every_commit_is_told_in_order() {
    let graph = world::ward();
    let vocabulary = graph.vocabulary();
    let score = vocabulary.attribute("score").unwrap();
    let barthel = graph.snapshot().node("barthel").unwrap();
    let feed = graph.subscribe_deltas();
    let start = graph.snapshot().version().0;
    let (threads, rounds) = (4, 50);

    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                for _ in 0..rounds {
                    graph
                        .update(AgentId::DSR, Time(0), |snapshot, tx| {
                            let old = snapshot.attribute(barthel, score).and_then(dsr::Value::as_number);
                            tx.set_attribute(NodeRef::from(barthel), score, old.unwrap_or(0.0) + 1.0);
                        })
                        .unwrap();
                }
            });
        }
    });
    let total = graph.snapshot().attribute(barthel, score).and_then(dsr::Value::as_number);
    assert_eq!(total, Some(f64::from(threads * rounds)));
    let versions: Vec<_> =
        std::iter::from_fn(|| feed.try_recv()).map(|event| event.snapshot().version().0).collect();
    assert!(versions.into_iter().eq(start + 1..=start + u64::from(threads as u32 * rounds as u32)));
}

/// Each commit writes two attributes to one value: every reader sees them agree, and never goes back in time,
/// whether the states that it meets were edited in place or copied.
#[test]
fn readers_see_whole_commits_in_order() {
    let graph = world::ward();
    let vocabulary = graph.vocabulary();
    let (score, urgent) = (vocabulary.attribute("score").unwrap(), vocabulary.attribute("urgent").unwrap());
    let barthel = graph.snapshot().node("barthel").unwrap();
    let (writers, readers, rounds) = (4_u32, 4, 200_u32);
    let start = graph.snapshot().version().0;
    let read = |snapshot: &dsr::Snapshot| {
        let number = snapshot.attribute(barthel, score).and_then(dsr::Value::as_number).unwrap_or(0.0);
        (number, snapshot.attribute(barthel, urgent).and_then(dsr::Value::as_bool).unwrap_or(false))
    };
    std::thread::scope(|scope| {
        for _ in 0..writers {
            scope.spawn(|| {
                for _ in 0..rounds {
                    let next = |snapshot: &dsr::Snapshot, tx: &mut dsr::Transaction| {
                        let (number, odd) = read(snapshot);
                        tx.set_attribute(barthel, score, number + 1.0).set_attribute(barthel, urgent, !odd);
                    };
                    graph.update(AgentId::DSR, Time(0), next).unwrap();
                }
            });
        }
        for _ in 0..readers {
            scope.spawn(|| {
                let (mut last, mut kept) = (0, Vec::new());
                while last < start + u64::from(writers * rounds) {
                    let now = graph.snapshot();
                    let (number, odd) = read(&now);
                    assert_eq!(number % 2.0 == 1.0, odd, "both or neither");
                    assert!(now.version().0 >= last, "time goes on");
                    last = now.version().0;
                    // Some are kept for a while, so that commits meet every mixture of held and free pages.
                    kept.push((now, number));
                    if kept.len() > 7 {
                        kept.drain(..).for_each(|(then, number)| assert_eq!(read(&then).0, number));
                    }
                }
            });
        }
    });
    assert_eq!(read(&graph.snapshot()).0, f64::from(writers * rounds));
}

#[test]
fn a_blocked_subscriber_is_woken_by_a_match_and_by_the_end() {
    let graph = world::ward();
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    let test = pattern.variable("test", vocabulary.node_type("test").unwrap());
    pattern.guard(test, vocabulary.attribute("score").unwrap(), Comparison::GreaterOrEqual, 100.0);
    let mut full = graph.subscribe(pattern.build().unwrap());
    let wakes = Arc::new(AtomicUsize::new(0));
    let counter = Arc::clone(&wakes);
    full.on_wake(move || _ = counter.fetch_add(1, Ordering::SeqCst));

    let waiting =
        std::thread::spawn(move || (full.recv().map(|change| change.version), full.recv().is_none()));
    world::commit(&graph, "dsr", "edge clarc is speaking").unwrap();
    let hundred = world::commit(&graph, "dsr", "set barthel score number 100").unwrap();
    drop(graph);
    assert_eq!(waiting.join().unwrap(), (Some(hundred.version), true));
    // Once for what was there to be looked at, once for the score, once for the end; not for the speech.
    assert_eq!(wakes.load(Ordering::SeqCst), 3);
}

#[test]
fn an_overflowing_queue_lags_and_goes_on_from_the_newest_state() {
    let graph = world::ward();
    let feed = graph.subscribe_deltas_with(std::num::NonZeroUsize::new(2).unwrap());
    for score in 0..5 {
        world::commit(&graph, "dsr", &format!("set barthel score number {score}")).unwrap();
    }
    let Some(Event::Lagged { missed, snapshot }) = feed.try_recv() else { panic!("the queue holds two") };
    assert_eq!((missed, snapshot.version()), (5, graph.snapshot().version()));
    assert!(feed.try_recv().is_none() && !feed.is_closed());
    world::commit(&graph, "dsr", "edge clarc is speaking").unwrap();
    assert!(matches!(feed.try_recv(), Some(Event::Committed(_))));
}

/// Would wait for ever if a callback went while its queue is locked.
#[test]
fn a_callback_that_commits_when_it_goes_may_be_replaced() {
    struct Last(Graph);
    impl Drop for Last {
        fn drop(&mut self) {
            world::commit(&self.0, "dsr", "no-edge carlos is_with clarc").unwrap();
        }
    }
    let graph = world::ward();
    let feed = graph.subscribe_deltas();
    let last = Last(graph.clone());
    feed.on_wake(move || _ = &last);
    feed.on_wake(|| {});
    assert!(feed.try_recv().is_some(), "it has committed");
}

/// A subscriber that never reads keeps no old state: after an overflow, not even the first one.
#[test]
fn the_first_state_goes_when_it_is_of_no_use() {
    let graph = world::ward();
    let two = std::num::NonZeroUsize::new(2).unwrap();
    let (diligent, idle) = (graph.subscribe_deltas(), graph.subscribe_deltas_with(two));
    let first = graph.snapshot().version();
    assert_eq!(diligent.start().map(|start| start.version()), Some(first));
    for at in 0..3 {
        world::commit(&graph, "dsr", &format!("node n{at} part")).unwrap();
    }
    assert!(diligent.start().is_some() && diligent.try_recv().is_some());
    assert!(diligent.start().is_none() && idle.start().is_none());
}

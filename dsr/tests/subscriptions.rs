//! Which subscribers receive a commit, and what happens to subscribers that do not read.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::num::NonZeroUsize;
use std::sync::atomic::Ordering;

use dsr::{Comparison, Delivery, Graph, HolderTerm, Mailbox, MatchChange, Pattern, PatternBuilder};

fn commit(graph: &Graph, lines: &str) {
    world::commit(graph, "dsr", lines).unwrap();
}

/// Each line is a commit, with the number of changes that each watcher received and the matches that it has.
#[test]
fn only_those_whom_a_commit_may_concern_are_told() {
    let graph = world::ward();
    let by_value = |wanted: f64| {
        world::watch(&graph, move |p, d| {
            let (test, part) = (
                p.variable("test", d.node_type("test").unwrap()),
                p.variable("part", d.node_type("part").unwrap()),
            );
            p.edge(test, d.label("is_in").unwrap(), part);
            p.guard(test, d.attribute("score").unwrap(), Comparison::Equal, wanted);
        })
    };
    let beside = |label: &'static str| {
        world::watch(&graph, move |p, d| {
            let (a, b) = (
                p.variable("a", d.node_type("person").unwrap()),
                p.variable("b", d.node_type("robot").unwrap()),
            );
            let c = p.variable("c", dsr::TypeId::OBJECT);
            p.edge(a, d.label("is_with").unwrap(), b).edge(b, d.label(label).unwrap(), c);
        })
    };
    let by_type = |wanted: &'static str| {
        world::watch(&graph, move |p, d| {
            let who = p.variable("who", d.node_type(wanted).unwrap());
            let what = p.variable("what", d.node_type("activity").unwrap());
            p.edge(who, d.label("is").unwrap(), what);
        })
    };
    let crossing = |wanted: f64| {
        world::watch(&graph, move |p, d| {
            let test = p.variable("test", d.node_type("test").unwrap());
            p.guard(test, d.attribute("score").unwrap(), Comparison::GreaterOrEqual, wanted);
        })
    };
    let watchers = [
        by_value(5.0),
        by_value(6.0),
        beside("is"),
        beside("knows"),
        by_type("robot"),
        by_type("person"),
        crossing(3.0),
        crossing(5.0),
        crossing(7.0),
    ];
    let mut seen = String::new();
    let mut watchers = watchers;
    for line in [
        "set barthel score number 5",
        "edge barthel is_in bathing",
        "no-edge barthel is_in bathing",
        "set barthel score number 6",
        "edge clarc is speaking",
        "no-edge carlos is_with clarc",
        "edge carlos is speaking",
        "edge clarc knows carlos\nedge carlos is_with clarc",
        "set barthel score number 4",
        "clear barthel score",
        "no-node clarc",
    ] {
        let before: Vec<_> = watchers.iter().map(|(_, told)| told.load(Ordering::SeqCst)).collect();
        // Joints are taken off first where a node goes.
        let line = if line == "no-node clarc" {
            "no-transform clarc camera\nno-transform world clarc\nno-node clarc"
        } else {
            line
        };
        commit(&graph, line);
        let mut row = String::new();
        for ((matches, told), before) in watchers.iter_mut().zip(before) {
            while matches.try_recv().is_some() {}
            let scratch = matches.pattern().matches(&graph.snapshot());
            assert!(matches.held().iter().eq(&scratch), "{line}");
            row += &format!(" {}/{}", told.load(Ordering::SeqCst) - before, matches.held().len());
        }
        seen += &format!("{}:{row}\n", line.lines().last().unwrap_or_default());
    }
    expect_test::expect![[r#"
        set barthel score number 5: 1/1 0/0 0/0 0/0 0/0 0/0 1/1 1/1 0/0
        edge barthel is_in bathing: 1/2 0/0 0/0 0/0 0/0 0/0 0/1 0/1 0/0
        no-edge barthel is_in bathing: 1/1 0/0 0/0 0/0 0/0 0/0 0/1 0/1 0/0
        set barthel score number 6: 1/0 1/1 0/0 0/0 0/0 0/0 0/1 1/1 0/0
        edge clarc is speaking: 0/0 0/1 1/1 0/0 1/1 0/0 0/1 0/1 0/0
        no-edge carlos is_with clarc: 0/0 0/1 1/0 0/0 0/1 0/0 0/1 0/1 0/0
        edge carlos is speaking: 0/0 0/1 0/0 0/0 0/1 1/1 0/1 0/1 0/0
        edge carlos is_with clarc: 0/0 0/1 1/1 1/1 0/1 0/1 0/1 0/1 0/0
        set barthel score number 4: 0/0 1/0 0/1 0/1 0/1 0/1 0/1 1/0 0/0
        clear barthel score: 0/0 0/0 0/1 0/1 0/1 0/1 1/0 0/0 0/0
        no-node clarc: 0/0 0/0 1/0 1/0 1/0 0/1 0/0 0/0 0/0
    "#]]
    .assert_eq(&seen);
}

fn scored(graph: &Graph) -> Pattern {
    let vocabulary = graph.vocabulary();
    let mut pattern = PatternBuilder::new(&vocabulary);
    let test = pattern.variable("test", vocabulary.node_type("test").unwrap());
    let holder = HolderTerm::node(test);
    pattern.guard(holder, vocabulary.attribute("score").unwrap(), Comparison::Equal, 1.0);
    pattern.build().unwrap()
}

fn counts(change: Option<MatchChange>) -> Option<(usize, usize, u64)> {
    change.map(|change| (change.appeared.len(), change.disappeared.len(), change.missed))
}

#[test]
fn the_newest_is_told_as_one_change_and_what_came_and_went_is_not() {
    let graph = world::ward();
    let mut each = graph.subscribe(scored(&graph));
    let mut newest = graph.subscribe_with(scored(&graph), Delivery::Newest);
    assert!(each.try_recv().is_none() && newest.try_recv().is_none());
    for score in [1, 2, 1, 3] {
        commit(&graph, &format!("set barthel score number {score}"));
    }
    let all: Vec<_> = std::iter::from_fn(|| counts(each.try_recv())).collect();
    assert_eq!(all, [(1, 0, 0), (0, 1, 0), (1, 0, 0), (0, 1, 0)]);
    assert_eq!(counts(newest.try_recv()), None, "nothing is left of it");
    for score in [1, 2, 1] {
        commit(&graph, &format!("set barthel score number {score}"));
    }
    let change = newest.try_recv().unwrap();
    assert_eq!(change.version, graph.snapshot().version());
    assert_eq!((change.appeared.len(), change.missed), (1, 0));
    assert!(newest.try_recv().is_none());
}

#[test]
fn who_never_listens_keeps_no_old_state_and_resynchronises() {
    let graph = world::ward();
    for delivery in [Delivery::Each, Delivery::Newest] {
        let capacity = NonZeroUsize::new(3).unwrap();
        let mut matches = graph.subscribe_with(scored(&graph), Mailbox { capacity, delivery });
        while matches.try_recv().is_some() {}
        for score in (0..20).chain([1]) {
            commit(&graph, &format!("set barthel score number {}", f64::from(score) / 20.0));
            // The changes from 0 to 1 and back are delivered; the others do not concern the pattern.
            commit(&graph, "set barthel score number 1");
        }
        let change = matches.try_recv().unwrap();
        assert_eq!(change.version, graph.snapshot().version(), "on from the newest");
        assert!(change.missed > 30, "{}", change.missed);
        assert_eq!(matches.held().len(), 1);
        assert!(matches.try_recv().is_none());
        commit(&graph, "set barthel score number 2");
        assert_eq!(counts(matches.try_recv()), Some((0, 1, 0)));
    }
}

//! Looking at a graph: what differs between versions, what is remembered, patterns as text, pictures.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use dsr::{
    AgentId, Delta, Export, Graph, Pattern, PatternBuilder, PatternTextError, Snapshot, Time, Version,
};
use expect_test::expect;
use proptest::prelude::*;

const EDITS: [&str; 24] = [
    "node anna person",
    "no-node anna",
    "node bob person",
    "no-node bob",
    "edge anna is_with clarc",
    "no-edge anna is_with clarc",
    "edge carlos knows bob",
    "set-edge carlos knows bob since number 4",
    "set-edge carlos knows bob since number 5",
    "no-edge carlos knows bob",
    "set barthel score number 1",
    "set barthel score number 2",
    "clear barthel score",
    "set barthel patient node anna",
    "set barthel patient node carlos",
    "no-node carlos",
    "transform clarc anna 1 2 3 0.5",
    "transform world bob 0 0 0 0",
    "no-transform clarc anna",
    "sample clarc bob 3 1 1",
    "sample clarc bob 5 2 1",
    "sample clarc bob 10000000007 2 1",
    "no-transform clarc bob",
    "sample world carlos 4 2 1",
];

/// A state without the versions in which its parts were written.
fn timeless(snapshot: &Snapshot) -> Export {
    let mut export = snapshot.export();
    (export.version, export.time) = (Version(0), Time(0));
    for node in &mut export.nodes {
        node.since = Version(0);
        node.attributes.iter_mut().for_each(|a| a.since = Version(0));
    }
    for edge in &mut export.edges {
        edge.since = Version(0);
        edge.attributes.iter_mut().for_each(|a| a.since = Version(0));
    }
    export.transforms.iter_mut().for_each(|t| t.since = Version(0));
    // Ids that were given out and whose nodes are gone again leave no difference.
    export.next = export.nodes.last().unwrap().id;
    export
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn what_differs_leads_from_one_to_the_other(
        history in prop::collection::vec(prop::collection::vec(0..EDITS.len(), 1..3), 1..40),
        start in 0..40_usize,
    ) {
        let graph = world::ward();
        graph.remember(1_000);
        let first = graph.snapshot().version().0;
        for edits in &history {
            let lines: Vec<_> = edits.iter().map(|&at| EDITS[at]).collect();
            let _ = world::commit(&graph, "dsr", &lines.join("\n"));
        }
        let after = graph.snapshot();
        let version = first + start as u64 % (after.version().0 - first + 1);
        let before = graph.at(Version(version)).unwrap();
        prop_assert_eq!(before.version().0, version);
        let changes = before.diff(&after);
        prop_assert!(before.diff(&before).is_empty());
        // Between states that share nothing, the same.
        let restored = Graph::restore(graph.vocabulary(), &after.export()).unwrap().snapshot();
        prop_assert_eq!(&before.diff(&restored), &changes);
        let delta = Delta {
            version: Version(version + 1),
            time: Time(0),
            writer: AgentId::DSR,
            changes,
            reflexes: Vec::new(),
        };
        let made = Graph::replay(graph.vocabulary(), &before.export(), [&delta]).unwrap();
        prop_assert_eq!(timeless(&made.snapshot()), timeless(&after));
    }
}

#[test]
fn the_last_versions_are_remembered_and_no_more() {
    let graph = world::ward();
    let first = graph.snapshot().version().0;
    world::commit(&graph, "dsr", "set barthel score number 0").unwrap();
    assert!(graph.at(Version(first)).is_none(), "it was not remembered");
    graph.remember(2);
    for round in 1..=5 {
        world::commit(&graph, "dsr", &format!("set barthel score number {round}")).unwrap();
    }
    let there: Vec<_> =
        (0..first + 9).filter(|&version| graph.at(Version(version)).is_some()).map(|v| v - first).collect();
    assert_eq!(there, [4, 5, 6]);
    graph.remember(0);
    assert!(graph.at(Version(first + 5)).is_none());
    assert_eq!(graph.at(Version(first + 6)).unwrap().version().0, first + 6);
}

#[test]
fn patterns_are_text() {
    let graph = world::ward();
    let lines = "node anna person\nedge anna is_with clarc\nedge clarc is speaking\nset barthel score number 7\n\
        set-edge barthel is_in feeding says text hello\nset barthel patient node anna";
    world::commit(&graph, "dsr", lines).unwrap();
    let (snapshot, vocabulary) = (graph.snapshot(), graph.vocabulary());
    let ask = |text: &str| -> Vec<String> {
        let pattern = Pattern::parse(&vocabulary, text).unwrap();
        let names = |row: dsr::Binding| {
            row.iter().map(|id| snapshot.name(*id).unwrap().to_owned()).collect::<Vec<_>>().join(" ")
        };
        pattern.matches(&snapshot).into_iter().map(names).collect()
    };
    assert_eq!(ask("(is_with ?who clarc)"), ["carlos", "anna"]);
    assert_eq!(ask("(and (is_with ?who ?r) (not (= (patient barthel) ?who)))"), ["carlos clarc"]);
    assert_eq!(ask("(and (person ?p) (not (is ?p speaking)) (distinct ?p anna))"), ["carlos"]);
    assert_eq!(ask("(and (is clarc speaking) (not (is_with anna clarc)))"), Vec::<String>::new());
    assert_eq!(ask("(and (test ?t) (> (score ?t) 6.5) (not (urgent ?t)))"), ["barthel"]);
    assert_eq!(ask("(= (says ?t ?part) \"hello\")"), ["barthel feeding"]);
    assert_eq!(ask("(and (< (distance ?a clarc) 2.1) (person ?a))"), ["carlos"]);
    assert_eq!(ask("(and)"), [""]);
    // What is said of a type inside a `not` is a part of it, and of two types the narrower counts.
    assert_eq!(ask("(and (is_with ?x ?r) (not (robot ?x)))"), ["carlos clarc", "anna clarc"]);
    assert_eq!(ask("(and (place ?x) (is ?x ?a) (not (person ?x)))"), ["clarc speaking"]);
    assert_eq!(
        ask("(and (place ?x) (not (and (robot ?x) (is ?x speaking))) (not (person ?x)))"),
        ["world", "camera"]
    );
    assert_eq!(ask("(and (robot ?x) (object ?x))"), ["clarc"]);
    assert_eq!(ask("(and (object ?x) (robot ?x))"), ["clarc"]);
    assert_eq!(ask("(not (and (robot ?x) (test ?y)))"), Vec::<String>::new());
    assert_eq!(ask("(and (person carlos) (not (robot carlos)) (not (person nobody)))"), [""]);
    assert_eq!(ask("(and (robot ?r) (not (and (is_with ?x ?r) (is ?x listening))))"), ["clarc"]);
}

#[test]
fn only_the_variables_of_a_pattern_are_fixed() {
    let graph = world::ward();
    let (snapshot, vocabulary) = (graph.snapshot(), graph.vocabulary());
    let (person, is) = (vocabulary.node_type("person").unwrap(), vocabulary.label("is").unwrap());
    let mut builder = PatternBuilder::new(&vocabulary);
    let who = builder.variable("who", person);
    let local = builder.without(|builder| {
        let what = builder.variable("what", vocabulary.node_type("activity").unwrap());
        builder.edge(who, is, what);
        what
    });
    let pattern = builder.build().unwrap();
    let mut larger = PatternBuilder::new(&vocabulary);
    let foreign = ["a", "b"].map(|name| larger.variable(name, person))[1];
    let carlos = snapshot.node("carlos").unwrap();
    assert!(pattern.holds_with(&snapshot, &[(who, carlos)]));
    // Not as if nothing were fixed: a debug build stops, any other finds nothing.
    for (variable, node) in [(local, snapshot.node("speaking").unwrap()), (foreign, carlos)] {
        let found = std::panic::catch_unwind(|| pattern.matches_with(&snapshot, &[(variable, node)]));
        assert_eq!(found.is_err(), cfg!(debug_assertions));
        assert_eq!(found.unwrap_or_default(), []);
    }
}

#[test]
fn what_is_no_pattern_is_told_with_its_place() {
    let vocabulary = world::vocabulary();
    let mut told = String::new();
    for text in [
        "",
        "(is_with ?a",
        "(is_with ?a ?b) x",
        "clarc",
        "(is_with ?a)",
        "(likes ?a ?b)",
        "(< (score ?t) high)",
        "(score ?a ?b)",
        "(not)",
        "(= (says ?t ?p) \"open)",
        "(is_with clarc ?b",
        "(and (robot ?r) (test ?t) (is_with ?t ?r))",
        "(< (distance ?a ?b) far)",
        "(< (bearing ?a ?b) 1 far)",
        "(< (distance ?a ?b) 2 1)",
        "(< (distance ?a ?b) (score ?a))",
        "(< (score ?t) 1 2)",
        "(= (says ?t ?p) ?x)",
        "(< (score ?t) inf)",
        "((is_with ?a ?b))",
        "(and (robot ?r) (person ?r))",
        "(and (robot ?r) (not (person ?r)))",
        "(person)",
    ] {
        let error: PatternTextError = Pattern::parse(&vocabulary, text).unwrap_err();
        told += &format!("{text}\n    {error}\n");
    }
    let deep = "(not ".repeat(50) + &")".repeat(50);
    assert!(matches!(Pattern::parse(&vocabulary, &deep), Err(PatternTextError::TooDeep { .. })));
    expect![[r#"

            byte 0: `(` is missing
        (is_with ?a
            byte 11: `)` is missing
        (is_with ?a ?b) x
            byte 16: the end is missing
        clarc
            byte 0: a part such as `(LABEL a b)` belongs here
        (is_with ?a)
            byte 0: `is_with` takes two nodes
        (likes ?a ?b)
            byte 0: `likes` is no label, attribute or type, and not one of `and`, `not`, `distinct`, `=`, `<` …
        (< (score ?t) high)
            byte 14: a number belongs here
        (score ?a ?b)
            byte 0: `score` takes one node
        (not)
            byte 0: `not` takes one part
        (= (says ?t ?p) "open)
            byte 22: `"` is missing
        (is_with clarc ?b
            byte 17: `)` is missing
        (and (robot ?r) (test ?t) (is_with ?t ?r))
            byte 26: 'is_with' never goes from a 'test' to a 'robot'
        (< (distance ?a ?b) far)
            byte 20: a number of metres belongs here
        (< (bearing ?a ?b) 1 far)
            byte 21: a number of radians belongs here
        (< (distance ?a ?b) 2 1)
            byte 0: invalid threshold: appears at 2, disappears at 1
        (< (distance ?a ?b) (score ?a))
            byte 20: `<=` and an attribute of the first node belongs here
        (< (score ?t) 1 2)
            byte 0: `<` takes two sides
        (= (says ?t ?p) ?x)
            byte 16: a text belongs here
        (< (score ?t) inf)
            byte 14: a number belongs here
        ((is_with ?a ?b))
            byte 0: a part such as `(LABEL a b)` belongs here
        (and (robot ?r) (person ?r))
            byte 24: `?r` is a `robot` and so never a `person`
        (and (robot ?r) (not (person ?r)))
            byte 29: `?r` is a `robot` and so never a `person`
        (person)
            byte 0: `person` takes one node
    "#]]
    .assert_eq(&told);
}

//! Looking at a graph: what differs between versions, what is remembered, patterns as text, pictures.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use dsr::{
    AgentId, Covariance, Delta, Export, Graph, Kind, Nature, NewValue, Pattern, PatternBuilder,
    PatternTextError, Pose, Snapshot, Time, Transaction, Version, VocabularyBuilder,
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
    assert!(graph.at(Version(first)).is_none(), "nobody asked for it");
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
            byte 0: no threshold: appears at 2, disappears at 1
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

#[test]
fn a_state_is_sentences_and_pictures() {
    let graph = world::ward();
    let lines = "node a<b person\nedge a<b is_with clarc\nset-edge barthel is_in feeding says text \"hi\"";
    world::commit(&graph, "dsr", lines).unwrap();
    let snapshot = graph.snapshot();
    let clarc = snapshot.around(snapshot.node("clarc").unwrap(), 1);
    expect![[r#"
        world (place)
        clarc (robot)
          clarc at (1.000, 0.000, 0.000) in world
        camera (place)
          camera at (0.000, 0.000, 1.500) in clarc
        carlos (person)
          carlos at (3.000, 0.000, 0.000) in world
          carlos is with clarc
        a<b (person)
          a<b is with clarc
    "#]]
    .assert_eq(&(clarc.lines().join("\n") + "\n"));
    let barthel = snapshot.around(snapshot.node("barthel").unwrap(), 1);
    expect![[r#"
        digraph dsr {
          node [shape=box];
          n12 [label="barthel\ntest"];
          n13 [label="feeding\npart"];
          n12 -> n13 [label="is_in\nsays: \"hi\""];
        }
    "#]]
    .assert_eq(&barthel.dot());
    expect![[r#"
        <?xml version="1.0" encoding="UTF-8"?>
        <graphml xmlns="http://graphml.graphdrawing.org/xmlns">
          <key id="k3" for="edge" attr.name="attribute.says" attr.type="string"/>
          <key id="k2" for="edge" attr.name="label" attr.type="string"/>
          <key id="k0" for="node" attr.name="name" attr.type="string"/>
          <key id="k1" for="node" attr.name="type" attr.type="string"/>
          <graph id="dsr" edgedefault="directed">
            <node id="n12">
              <data key="k0">barthel</data>
              <data key="k1">test</data>
            </node>
            <node id="n13">
              <data key="k0">feeding</data>
              <data key="k1">part</data>
            </node>
            <edge source="n12" target="n13">
              <data key="k2">is_in</data>
              <data key="k3">&quot;hi&quot;</data>
            </edge>
          </graph>
        </graphml>
    "#]]
    .assert_eq(&barthel.graphml());
    let svg = clarc.svg();
    assert_eq!(svg.matches("rx=").count(), 5, "five nodes");
    assert_eq!(svg.matches("<path").count(), 6, "three transforms, two edges, an arrow");
    assert!(svg.contains("a&lt;b") && !svg.contains("a<b") && !svg.contains("NaN"));
    assert_eq!(clarc.export().nodes.len(), 5);
    // All of it, with a cycle.
    world::commit(&graph, "dsr", "edge carlos knows a<b\nedge a<b knows clarc\nedge clarc knows carlos")
        .unwrap();
    let all = graph.snapshot();
    assert_eq!(all.view().svg().matches("rx=").count(), all.nodes().count());
}

#[test]
fn whatever_a_name_has_in_it_the_xml_is_well_formed() {
    let mut builder = VocabularyBuilder::new();
    let kind = builder.node_type("a type\u{ffff}", None, Nature::Geometric).unwrap();
    let level = builder.attribute_on_node("battery level\n\"1\"", kind, Kind::Text).unwrap();
    let graph = Graph::new(builder.build());
    let mut tx = Transaction::new(AgentId::DSR);
    tx.add_node("a\u{fffe}b", kind).add_node("c\u{0}\u{1b}<", kind);
    let error =
        Covariance::new(nalgebra::Matrix6::from_diagonal(&[0.25, 0.5, 1.0, 0.0, 0.0, 2.0].into())).unwrap();
    tx.set_transform("a\u{fffe}b", "c\u{0}\u{1b}<", Pose::new(world::pose([1.0, 2.0, 3.0, 0.0]), error));
    tx.set_attribute("a\u{fffe}b", level, NewValue::Text("one\r\ntwo\tthree\u{ffff}".into()));
    graph.commit(&tx, Time(0)).unwrap();
    let snapshot = graph.snapshot();
    let (graphml, svg) = (snapshot.view().graphml(), snapshot.view().svg());
    for xml in [&graphml, &svg] {
        let is_char = |c: char| c == '\n' || (c >= ' ' && c != '\u{fffe}' && c != '\u{ffff}');
        assert!(xml.chars().all(is_char), "{xml}");
    }
    let ids: Vec<_> =
        graphml.split("key id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()).collect();
    assert_eq!(ids.len(), 6);
    assert!(ids.iter().all(|id| id.chars().all(|c| c.is_ascii_alphanumeric())), "{ids:?}");
    let uses = graphml.split("data key=\"").skip(1).map(|rest| rest.split('"').next().unwrap());
    assert!(uses.clone().all(|id| ids.contains(&id)) && uses.count() > 6);
    assert!(graphml.contains("attr.name=\"attribute.battery level&#10;&quot;1&quot;\""), "{graphml}");
    assert!(graphml.contains(">one&#13;&#10;two&#9;three\u{fffd}<"), "{graphml}");
    let covariance = "0.25 0 0 0 0 0 0 0.5 0 0 0 0 0 0 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 2";
    assert!(graphml.contains(&format!(">{covariance}</data>")), "{graphml}");
}

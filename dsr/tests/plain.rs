//! Transactions, reflexes and patterns as plain data: what another process sends is what would have been written here.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::sync::Arc;

use dsr::{
    Bound, Comparison, Edit, HolderTerm, Keep, Metric, Operand, Pattern, PatternBuilder, PatternError,
    PatternSource, Preemption, Priority, Reflex, Threshold, Time, Transaction, Value,
};

/// With every kind of part.
fn pattern(graph: &dsr::Graph) -> Pattern {
    let d = graph.vocabulary();
    let (label, attribute) = (|name| d.label(name).unwrap(), |name| d.attribute(name).unwrap());
    let kind = |name| d.node_type(name).unwrap();
    let mut p = PatternBuilder::new(&d);
    let (who, test, part) = (
        p.variable("who", kind("person")),
        p.variable("test", kind("test")),
        p.variable("part", kind("part")),
    );
    let says = HolderTerm::edge(test, label("is_in"), part);
    p.edge(who, label("is_with"), "clarc").edge(test, label("is_in"), part).present(test, attribute("score"));
    p.guard(test, attribute("score"), Comparison::LessOrEqual, 5.0).distinct(who, "camera");
    let near = Threshold { appears: 2.5, disappears: 3.0 };
    p.metric(Metric::Distance, who, "clarc", Comparison::Less, near);
    p.without(|p| {
        let other = p.variable("other", kind("person"));
        p.edge(who, label("knows"), other).is_a(other, kind("place"));
        p.guard(says.clone(), attribute("says"), Comparison::Equal, Value::text("no"));
        p.guard(
            says.clone(),
            attribute("says"),
            Comparison::NotEqual,
            Operand::Attribute(says, attribute("says")),
        );
    });
    p.build().unwrap()
}

#[test]
fn a_transaction_is_the_same_from_another_process() {
    let (here, there) = (world::ward(), world::ward());
    let set_up = "set barthel score number 3";
    for graph in [&here, &there] {
        world::commit(graph, "dsr", set_up).unwrap();
    }
    let d = here.vocabulary();
    let (speech, speaker) = (world::agent(&d, "speech"), d.resource("speaker").unwrap());
    let kept = Arc::new(pattern(&here));
    let who = (kept.variable("who").unwrap(), here.snapshot().node("carlos").unwrap());
    let stop =
        Edit::RemoveEdge { from: "clarc".into(), label: d.label("is").unwrap(), to: "speaking".into() };
    let mut tx = Transaction::new(speech);
    tx.claim(speaker, Priority(2), Preemption::Finishes).expect_version(here.snapshot().version());
    tx.add_edge("clarc", d.label("is").unwrap(), "speaking").guard(Reflex {
        owner: speech,
        keep: vec![Keep::from(Bound { pattern: kept, binding: vec![who] })],
        on_break: vec![stop],
        leases: vec![speaker],
    });
    let sent = serde_json::to_string(&tx).unwrap();
    let read: Transaction<PatternSource> = serde_json::from_str(&sent).unwrap();
    let built = read.build(&there.vocabulary()).unwrap();
    assert_eq!(serde_json::to_string(&built).unwrap(), sent);
    let (one, two) = (here.commit(&tx, Time(1)).unwrap(), there.commit(&built, Time(1)).unwrap());
    assert_eq!((one.delta, one.guards), (two.delta, two.guards));
    assert_eq!(world::bytes(&here), world::bytes(&there));
    // The reflex too: it fires for the same reason.
    for lines in ["sample world anna 1 0 0", "set barthel score number 4", "set barthel score number 6"] {
        let delta = |graph| world::commit(graph, "dsr", lines).map(|commit| commit.delta);
        let (one, two) = (delta(&here), delta(&there));
        assert_eq!(one, two);
        assert_eq!(one.is_ok_and(|delta| !delta.reflexes.is_empty()), lines.ends_with('6'));
    }
    let lease = serde_json::to_string(&there.snapshot().lease(speaker)).unwrap();
    assert_eq!(lease, "null", "the reflex gave it back");
}

#[test]
fn what_is_read_is_checked() {
    let graph = world::ward();
    let json = serde_json::to_string(&pattern(&graph)).unwrap();
    let source = |json: &str| serde_json::from_str::<PatternSource>(json).unwrap();
    assert!(source(&json).build(&graph.vocabulary()).is_ok());
    let other = dsr::VocabularyBuilder::new().build();
    assert!(matches!(source(&json).build(&other), Err(PatternError::UnknownType { .. })));
    let strange = json.replace("\"index\":2", "\"index\":7");
    assert_ne!(strange, json);
    assert!(source(&strange).build(&graph.vocabulary()).is_err());
    // A part that declares a variable of the pattern, and a variable that no part declares.
    let local = r#"{"variable":{"scope":"local","index":0}}"#;
    let again = json.replace(
        &format!(r#""variables":[{local}]"#),
        r#""variables":[{"variable":{"scope":"top","index":0}}]"#,
    );
    assert_ne!(again, json);
    assert!(matches!(source(&again).build(&graph.vocabulary()), Err(PatternError::Misdeclared { .. })));
    let never = json.replace(&format!(r#""variables":[{local}]"#), r#""variables":[]"#);
    assert_ne!(never, json);
    assert!(source(&never).build(&graph.vocabulary()).is_err());
}

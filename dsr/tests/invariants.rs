//! Every broken invariant is a typed error and leaves the graph as it was. A case is a file in `invariants/`.
#![allow(clippy::unwrap_used, reason = "a test that fails says where")]

mod world;

use std::path::Path;

use serde_json::Value;

#[test]
fn each_broken_invariant_is_named_and_changes_nothing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/invariants");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut wrong = Vec::new();
    for file in &files {
        let case: Value = toml::from_str(&std::fs::read_to_string(file).unwrap()).unwrap();
        let text = |key: &str| case[key].as_str().unwrap();
        let graph = world::ward();
        if let Some(before) = case.get("before") {
            let field = |key: &str| before[key].as_str().unwrap();
            world::commit(&graph, field("writer"), field("edits")).unwrap();
        }
        let before = world::bytes(&graph);
        let deltas = graph.subscribe_deltas();
        let found = match world::commit(&graph, text("writer"), text("edits")) {
            Ok(_) => "(accepted)".to_owned(),
            Err(error) => {
                let variant: String =
                    format!("{error:?}").chars().take_while(|c| c.is_alphanumeric()).collect();
                format!("{variant}: {error}")
            }
        };
        let expected = format!("{}: {}", text("breaks"), text("says"));
        if found != expected || before != world::bytes(&graph) || deltas.try_recv().is_some() {
            wrong.push(format!("{}\n  expected {expected}\n  found    {found}", file.display()));
        }
    }
    assert!(files.len() >= 40, "cases are missing: {} left", files.len());
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Ids of another vocabulary cannot be written in a case file.
#[test]
fn foreign_ids_are_errors_not_panics() {
    use dsr::{AgentId, Graph, Nature, Time, TransactionError as E, VocabularyBuilder};
    let large = world::vocabulary();
    let mut small = VocabularyBuilder::new();
    let place = small.node_type("place", None, Nature::Geometric).unwrap();
    let graph = Graph::new(small.build());
    let edit = |write: &dyn Fn(&mut dsr::Transaction)| {
        graph.edit(AgentId::DSR, Time(0), |tx| write(tx)).unwrap_err()
    };
    edit(&|tx| {
        tx.add_node("a", place).add_node("b", large.node_type("part").unwrap());
    });
    let (label, attribute) = (large.label("is_in").unwrap(), large.attribute("says").unwrap());
    assert!(matches!(edit(&|tx| _ = tx.add_edge("dsr", label, "dsr")), E::UnknownLabel { .. }));
    assert!(matches!(edit(&|tx| _ = tx.set_attribute("dsr", attribute, 1.0)), E::UnknownAttribute { .. }));
    assert!(matches!(
        edit(&|tx| _ = tx.release(large.resource("speaker").unwrap())),
        E::UnknownResource { .. }
    ));
    let stranger = large.agent("speech").unwrap();
    assert!(matches!(graph.edit(stranger, Time(0), |_| {}).unwrap_err(), E::UnknownAgent { .. }));
    assert!(matches!(graph.expire(stranger, Time(0)).unwrap_err(), E::UnknownAgent { .. }));
    assert_eq!(graph.snapshot().version().0, 0);
}

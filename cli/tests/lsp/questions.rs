//! One answer of each kind, over a domain, a problem, a closed problem and a plan.

use crate::client::Client;
use crate::{position, range};
use serde_json::{Value, json};

const DOMAIN: &str = "(define (domain depot) ; 😀 é
  (:requirements :strips :typing)
  (:types crate place)
  ;; Where a crate stands.
  (:predicates (at ?c - crate ?p - place))
  (:action move
    :parameters (?c - crate ?from - place ?to - place)
    :precondition (at ?c ?from)
    :effect (and (not (at ?c ?from)) (at ?c ?to))))
";
const PROBLEM: &str = "(define (problem one) (:domain depot)\r\n  (:objects a - crate x y - place)\r\n  (:init (at a x)) (:goal (at a y)))\r\n";
const PLAN: &str = "; 😀\n(move a x y)\n";

fn begin() -> Client {
    let closed = PROBLEM.replace("one", "two");
    let files = [("d.pddl", DOMAIN), ("p.pddl", PROBLEM), ("closed/q.pddl", &closed), ("p.plan", PLAN)];
    let mut client = Client::begin_with(&files, &json!({"lints": false}), &["utf-16"]);
    client.open("d.pddl", DOMAIN);
    client.open("p.pddl", PROBLEM);
    client
}

fn of_document(client: &mut Client, method: &str, name: &str) -> Value {
    let uri = client.uri(name);
    client.ask(method, json!({"textDocument": {"uri": uri}})).unwrap()
}

#[test]
fn hover_and_definition() {
    let mut client = begin();
    let hover = client.ask_at("textDocument/hover", "p.pddl", 2, 11).unwrap();
    assert_eq!(hover["contents"]["kind"], "markdown");
    assert!(hover["contents"]["value"].as_str().unwrap().contains("(at ?c - crate ?p - place)"), "{hover}");
    assert_eq!(hover["range"], range(2, 10, 12));
    let definition = client.ask_at("textDocument/definition", "p.pddl", 2, 11).unwrap();
    assert_eq!(definition, json!([{"uri": client.uri("d.pddl"), "range": range(4, 16, 18)}]));
    let nothing = client.ask_at("textDocument/definition", "p.pddl", 99, 99).unwrap();
    assert_eq!(nothing, Value::Null);
    assert_eq!(client.end(), 0);
}

#[test]
fn references_reach_closed_files_and_plans() {
    let mut client = begin();
    let uri = client.uri("d.pddl");
    let mut ask = |declarations: bool| {
        let params = json!({"textDocument": {"uri": uri}, "position": position(5, 12),
            "context": {"includeDeclaration": declarations}});
        client.ask("textDocument/references", params).unwrap().as_array().unwrap().len()
    };
    assert_eq!((ask(true), ask(false)), (2, 1), "the action, and the plan");
    let highlights = client.ask_at("textDocument/documentHighlight", "d.pddl", 4, 17).unwrap();
    assert_eq!(highlights.as_array().unwrap().len(), 4);
    assert_eq!(client.end(), 0);
}

#[test]
fn renaming_reaches_closed_files() {
    let mut client = begin();
    let prepared = client.ask_at("textDocument/prepareRename", "p.pddl", 2, 11).unwrap();
    assert_eq!(prepared, json!({"range": range(2, 10, 12), "placeholder": "at"}));
    let uri = client.uri("p.pddl");
    let params =
        |name: &str| json!({"textDocument": {"uri": uri}, "position": position(2, 11), "newName": name});
    let edit = client.ask("textDocument/rename", params("stands-at")).unwrap();
    let mut changed: Vec<(String, Value, usize)> = edit["documentChanges"]
        .as_array()
        .unwrap()
        .iter()
        .map(|change| {
            let document = &change["textDocument"];
            let edits = change["edits"].as_array().unwrap();
            assert!(edits.iter().all(|edit| edit["newText"] == "stands-at"));
            (document["uri"].as_str().unwrap().to_owned(), document["version"].clone(), edits.len())
        })
        .collect();
    changed.sort_by_key(|(uri, ..)| uri.clone());
    assert_eq!(
        changed,
        [
            (client.uri("closed/q.pddl"), Value::Null, 2),
            (client.uri("d.pddl"), json!(1), 4),
            (client.uri("p.pddl"), json!(1), 2),
        ]
    );
    let refused = client.ask("textDocument/rename", params("no name")).unwrap_err();
    assert_eq!(refused["code"], -32803);
    assert_eq!(client.ask_at("textDocument/prepareRename", "p.pddl", 2, 0), Ok(Value::Null));
    assert_eq!(client.end(), 0);
}

#[test]
fn outlines_and_symbols() {
    let mut client = begin();
    let outline = of_document(&mut client, "textDocument/documentSymbol", "d.pddl").to_string();
    for name in ["depot", "crate", "move"] {
        assert!(outline.contains(&format!("\"name\":\"{name}\"")), "{outline}");
    }
    let found = client.ask("workspace/symbol", json!({"query": "mve"})).unwrap();
    assert_eq!(
        (&found[0]["name"], &found[0]["location"]["uri"]),
        (&json!("move"), &json!(client.uri("d.pddl")))
    );
    assert_eq!(client.end(), 0);
}

#[test]
fn tokens_stand_where_they_are() {
    let mut client = begin();
    let tokens = of_document(&mut client, "textDocument/semanticTokens/full", "d.pddl");
    let data: Vec<u64> = tokens["data"].as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect();
    assert_eq!(data.len() % 5, 0);
    let lines: Vec<&str> = DOMAIN.lines().collect();
    let (mut line, mut column) = (0, 0);
    let mut words = Vec::new();
    for token in data.chunks(5) {
        column = if token[0] == 0 { column + token[1] } else { token[1] };
        line += token[0];
        let units: Vec<u16> = lines[usize::try_from(line).unwrap()].encode_utf16().collect();
        let (start, length) = (usize::try_from(column).unwrap(), usize::try_from(token[2]).unwrap());
        words.push((String::from_utf16(&units[start..start + length]).unwrap(), token[3]));
    }
    for (word, kind) in
        [("define", 1), ("depot", 4), ("; 😀 é", 0), (":typing", 13), ("crate", 5), ("?c", 9), ("move", 10)]
    {
        let known = words.iter().find(|(w, _)| w == word).unwrap_or_else(|| panic!("{word}: {words:?}"));
        assert_eq!(known.1, kind, "{word}");
    }
    let uri = client.uri("d.pddl");
    let some = client
        .ask(
            "textDocument/semanticTokens/range",
            json!({"textDocument": {"uri": uri}, "range": range(2, 0, 20)}),
        )
        .unwrap();
    let some = some["data"].as_array().unwrap();
    assert!(!some.is_empty() && some.len() < data.len());
    assert_eq!(some[0], 2);
    assert_eq!(client.end(), 0);
}

#[test]
fn folds_selections_and_layout() {
    let mut client = begin();
    let folds = of_document(&mut client, "textDocument/foldingRange", "d.pddl");
    assert!(
        folds
            .as_array()
            .unwrap()
            .iter()
            .any(|fold| (&fold["startLine"], &fold["endLine"]) == (&json!(5), &json!(8))),
        "{folds}"
    );
    let uri = client.uri("p.pddl");
    let selection = client
        .ask(
            "textDocument/selectionRange",
            json!({"textDocument": {"uri": uri}, "positions": [position(2, 11), position(0, 0)]}),
        )
        .unwrap();
    assert_eq!(selection[0]["range"], range(2, 10, 12));
    assert_eq!(selection[0]["parent"]["range"], range(2, 10, 16));
    assert_eq!(selection.as_array().unwrap().len(), 2);
    client.open("ugly.pddl", "(define   (domain ugly)\n(:predicates (p)))");
    let uri = client.uri("ugly.pddl");
    let options = json!({"tabSize": 2, "insertSpaces": true});
    let edits = client
        .ask("textDocument/formatting", json!({"textDocument": {"uri": uri}, "options": options}))
        .unwrap();
    client.change("ugly.pddl", 2, &changes(&edits));
    let again = client
        .ask("textDocument/formatting", json!({"textDocument": {"uri": uri}, "options": options}))
        .unwrap();
    assert_eq!(again, json!([]));
    client.change("ugly.pddl", 3, &json!([{"text": "(define (domain"}]));
    let refused =
        client.ask("textDocument/formatting", json!({"textDocument": {"uri": uri}, "options": options}));
    assert_eq!(refused.unwrap_err()["code"], -32803);
    assert_eq!(client.end(), 0);
}

/// Edits of one document as changes that can be made one after the other: from the end to the front.
fn changes(edits: &Value) -> Value {
    let edits = edits.as_array().unwrap().iter().rev();
    edits.map(|edit| json!({"range": edit["range"], "text": edit["newText"]})).collect()
}

#[test]
fn lenses_say_what_can_be_run() {
    let mut client = begin();
    let commands = |lenses: &Value| -> Vec<String> {
        let lenses = lenses.as_array().unwrap().iter();
        lenses.map(|lens| lens["command"]["command"].as_str().unwrap().to_owned()).collect()
    };
    let lenses = of_document(&mut client, "textDocument/codeLens", "p.pddl");
    assert_eq!(commands(&lenses), ["pelea.plan"]);
    assert_eq!(lenses[0]["command"]["arguments"], json!([client.uri("p.pddl")]));
    let lenses = of_document(&mut client, "textDocument/codeLens", "p.plan");
    assert_eq!(commands(&lenses), ["pelea.validate"]);
    client.tell("workspace/didChangeConfiguration", json!({"settings": {"pelea": {"codeLens": false}}}));
    assert_eq!(of_document(&mut client, "textDocument/codeLens", "p.pddl"), json!([]));
    assert_eq!(client.end(), 0);
}

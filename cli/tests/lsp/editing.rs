//! Diagnostics while texts change.

use crate::client::Client;
use crate::{position, range};
use serde_json::json;

const DOMAIN: &str = "(define (domain hall)\n  (:requirements :strips)\n  (:predicates (lit))\n  (:action switch\n    :parameters ()\n    :precondition (and)\n    :effect (lit)))\n";
const PROBLEM: &str = "(define (problem dark)\n  (:domain hall)\n  (:init)\n  (:goal (lit)))\n";

/// No lints, for tests of diagnostics that must be correct immediately.
fn begin(files: &[(&str, &str)], encoding: &str) -> Client {
    Client::begin_with(files, &json!({"lints": false}), &[encoding])
}

#[test]
fn what_is_wrong_comes_and_goes() {
    let mut client = begin(&[("d.pddl", DOMAIN)], "utf-16");
    client.open("p.pddl", &PROBLEM.replace("(lit)))", "(lti)))"));
    let wrong = client.diagnostics("p.pddl", Some(1));
    assert_eq!(wrong.len(), 1);
    assert_eq!((&wrong[0]["code"], &wrong[0]["source"]), (&json!("E0202"), &json!("pelea")));
    assert_eq!(wrong[0]["range"], range(3, 10, 13));
    assert!(wrong[0]["message"].as_str().unwrap().contains("did you mean `lit`?"));
    client.change("p.pddl", 2, &json!([{"range": range(3, 11, 13), "text": "it"}]));
    assert_eq!(client.codes("p.pddl", Some(2)), [""; 0]);
    assert_eq!(client.end(), 0);
}

#[test]
fn a_change_of_the_domain_reaches_its_problems_open_and_closed() {
    let files = [("a/d.pddl", DOMAIN), ("a/open.pddl", PROBLEM), ("a/closed.pddl", PROBLEM)];
    let mut client = begin(&files, "utf-16");
    client.open("a/d.pddl", DOMAIN);
    client.open("a/open.pddl", PROBLEM);
    assert_eq!(client.codes("a/open.pddl", Some(1)), [""; 0]);
    client.change("a/d.pddl", 2, &json!([{"text": DOMAIN.replace("lit", "bright")}]));
    assert_eq!(client.codes("a/d.pddl", Some(2)), [""; 0]);
    assert_eq!(client.codes("a/open.pddl", Some(1)), ["E0202"]);
    assert_eq!(client.codes("a/closed.pddl", None), ["E0202"]);
    // Closed without saving: the text on the disk counts again, and both problems are right.
    let uri = client.uri("a/d.pddl");
    client.tell("textDocument/didClose", json!({"textDocument": {"uri": uri}}));
    assert_eq!(client.codes("a/open.pddl", Some(1)), [""; 0]);
    assert_eq!(client.codes("a/closed.pddl", None), [""; 0]);
    assert_eq!(client.end(), 0);
}

#[test]
fn emoji_accents_and_line_ends_before_the_place() {
    let text = "; 😀 é\r\n(define (problem dark) ; 😀😀\r\n (:domain hall) (:goal (lit)) ; é\r(:gaol (lit)))";
    let edited = |client: &mut Client, columns: [u32; 2]| {
        client.open("p.pddl", text);
        let wrong = client.diagnostics("p.pddl", Some(1));
        // The comment up to the next line feed holds the last line, for a lone CR ends no line of PDDL.
        assert!(!wrong.is_empty());
        // Between the two faces, the comment becomes two lines, and the section behind it is right.
        let [from, to] = columns;
        client.change(
            "p.pddl",
            2,
            &json!([
                {"range": {"start": position(3, 0), "end": position(3, 14)}, "text": ""},
                {"range": range(1, from, to), "text": "\n(:init)"},
                {"range": {"start": position(3, 32), "end": position(99, 0)}, "text": "\n)"},
            ]),
        );
        assert_eq!(client.codes("p.pddl", Some(2)), [""; 0]);
    };
    for (encoding, columns) in [("utf-8", [29, 33]), ("utf-16", [27, 29]), ("utf-32", [26, 27])] {
        let mut client = begin(&[("d.pddl", DOMAIN)], encoding);
        edited(&mut client, columns);
        assert_eq!(client.end(), 0);
    }
}

#[test]
fn lints_come_when_nothing_happens() {
    let mut client = Client::begin_with(&[], &json!({"lintDelay": 1}), &["utf-16"]);
    let text = "(define (domain d) (:requirements :strips) (:predicates (p))\n (:action a :parameters (?x) :precondition (p) :effect (not (p))))";
    client.open("d.pddl", text);
    let warned =
        client.wait(|m| m["method"] == "textDocument/publishDiagnostics" && m.to_string().contains("W07"));
    let warnings = warned["params"]["diagnostics"].as_array().unwrap();
    let unused = warnings.iter().find(|d| d["message"].as_str().unwrap().contains("`?x`")).unwrap();
    assert_eq!(unused["severity"], 2);
    // The comment that allows it is offered, and does what it says.
    let uri = client.uri("d.pddl");
    let params = json!({"textDocument": {"uri": uri}, "range": unused["range"],
        "context": {"diagnostics": [unused]}});
    let actions = client.ask("textDocument/codeAction", params).unwrap();
    let allow =
        actions.as_array().unwrap().iter().find(|a| a["title"].as_str().unwrap().starts_with("Allow"));
    let edit = &allow.unwrap()["edit"]["documentChanges"][0]["edits"][0];
    assert!(edit["newText"].as_str().unwrap().contains("; allow("));
    assert_eq!(allow.unwrap()["diagnostics"][0]["code"], unused["code"]);
    client.change("d.pddl", 2, &json!([{"range": edit["range"], "text": edit["newText"]}]));
    client.wait(|m| {
        m["method"] == "textDocument/publishDiagnostics"
            && m["params"]["version"] == 2
            && !m.to_string().contains("`?x`")
    });
    assert_eq!(client.end(), 0);
}

#[test]
fn many_changes_at_once_and_a_cancellation() {
    let mut client = begin(&[("d.pddl", DOMAIN)], "utf-16");
    client.open("p.pddl", PROBLEM);
    for version in 2..200 {
        let text = if version % 2 == 0 { "(lti)" } else { "(lit)" };
        client.change("p.pddl", version, &json!([{"range": range(3, 9, 14), "text": text}]));
    }
    assert_eq!(client.codes("p.pddl", Some(199)), [""; 0]);
    // Whether it is withdrawn in time or answered before: there is one answer, and the session goes on.
    let uri = client.uri("p.pddl");
    let id = client
        .request("textDocument/hover", json!({"textDocument": {"uri": uri}, "position": position(3, 10)}));
    client.tell("$/cancelRequest", json!({"id": id}));
    if let Err(error) = client.answer(id) {
        assert_eq!(error["code"], -32800);
    }
    assert_eq!(client.end(), 0);
}

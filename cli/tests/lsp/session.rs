//! Beginning and end.

use crate::client::Client;
use serde_json::{Value, json};

#[test]
fn a_session_from_beginning_to_end() {
    let mut client = Client::silent(&[]);
    let result = client.ask("initialize", json!({"capabilities": {}})).unwrap();
    assert_eq!(result["serverInfo"]["name"], "pelea");
    assert_eq!(result["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(result["capabilities"]["textDocumentSync"]["change"], 2);
    assert!(result["capabilities"].get("diagnosticProvider").is_none());
    client.tell("initialized", json!({}));
    assert_eq!(client.end(), 0);
}

#[test]
fn exit_without_shutdown_is_a_failure() {
    let mut client = Client::begin(&[]);
    client.tell("exit", Value::Null);
    assert_eq!(client.code(), 1);
    let mut client = Client::silent(&[]);
    client.tell("exit", Value::Null);
    assert_eq!(client.code(), 1);
}

#[test]
fn a_client_that_vanishes_takes_the_server_along() {
    let mut client = Client::begin(&[]);
    client.hang_up();
    assert_eq!(client.code(), 1);
}

#[test]
fn requests_out_of_turn_are_refused() {
    let mut client = Client::silent(&[]);
    let early = client.ask("textDocument/hover", json!({})).unwrap_err();
    assert_eq!(early["code"], -32002);
    client.ask("initialize", json!({"capabilities": {}})).unwrap();
    let twice = client.ask("initialize", json!({"capabilities": {}})).unwrap_err();
    assert_eq!(twice["code"], -32600);
    client.ask("shutdown", Value::Null).unwrap();
    let late = client.ask("textDocument/hover", json!({})).unwrap_err();
    assert_eq!(late["code"], -32600);
    client.tell("exit", Value::Null);
    assert_eq!(client.code(), 0);
}

#[test]
fn odd_capabilities_are_accepted() {
    let mut client = Client::silent(&[]);
    let params = json!({"capabilities": {"textDocument": 5, "workspace": {"workspaceEdit": []},
        "general": {"positionEncodings": ["utf-7", 3]}}, "workspaceFolders": 7, "trace": "loud"});
    let result = client.ask("initialize", params).unwrap();
    assert_eq!(result["capabilities"]["positionEncoding"], "utf-16");
    assert_eq!(client.end(), 0);
}

#[test]
fn options_that_cannot_be_used_are_said() {
    let mut client = Client::begin_with(&[], &json!({"lints": 3, "maxfiles": 1}), &["utf-8"]);
    for word in ["`lints` cannot be 3", "no option `maxfiles`"] {
        client.wait(|m| {
            m["method"] == "window/showMessage" && m["params"]["message"].as_str().unwrap().contains(word)
        });
    }
    assert_eq!(client.end(), 0);
}

#[test]
fn clients_that_ask_get_what_is_wrong() {
    let options = json!({"diagnostics": "pull"});
    let mut client = Client::silent(&[]);
    let params = json!({"capabilities": {}, "initializationOptions": options});
    let result = client.ask("initialize", params).unwrap();
    assert_eq!(result["capabilities"]["diagnosticProvider"]["interFileDependencies"], true);
    client.open("d.pddl", "(define (domain d) (:predicates (p)) (:action a :effect (q)))");
    let uri = client.uri("d.pddl");
    let report = client.ask("textDocument/diagnostic", json!({"textDocument": {"uri": uri}})).unwrap();
    assert_eq!(report["kind"], "full");
    assert_eq!(report["items"][0]["code"], "E0202");
    assert_eq!(client.end(), 0);
}

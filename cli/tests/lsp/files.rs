//! Folders, files on the disk, and their names.

use crate::client::Client;
use serde_json::json;

const DOMAIN: &str = "(define (domain hall) (:predicates (lit)))";
const PROBLEM: &str = "(define (problem dark) (:domain hall) (:init) (:goal (lit)))";

fn begin(files: &[(&str, &str)]) -> Client {
    Client::begin_with(files, &json!({"lints": false}), &["utf-16"])
}

#[test]
fn names_with_spaces_and_accents() {
    let folder = "eine Mappe/größer #1 100%";
    let (domain, problem) = (format!("{folder}/dömäin.pddl"), format!("{folder}/пример 1.pddl"));
    let mut client = begin(&[(&domain, DOMAIN)]);
    client.open(&problem, PROBLEM);
    client.change(&problem, 2, &json!([{"text": PROBLEM.replace("lit", "lti")}]));
    assert_eq!(client.codes(&problem, Some(2)), ["E0202"]);
    assert_eq!(client.end(), 0);
}

#[test]
fn files_that_come_change_and_go() {
    let mut client = begin(&[]);
    client.wait(|m| m["method"] == "client/registerCapability");
    client.open("p.pddl", PROBLEM);
    assert_eq!(client.codes("p.pddl", Some(1)), ["E0212"]);
    let uri = client.uri("d.pddl");
    let tell = |client: &mut Client, text: Option<&str>, kind: i32| {
        let path = client.path("d.pddl");
        match text {
            Some(text) => std::fs::write(path, text).unwrap(),
            None => std::fs::remove_file(path).unwrap(),
        }
        client.tell("workspace/didChangeWatchedFiles", json!({"changes": [{"uri": uri, "type": kind}]}));
    };
    tell(&mut client, Some(DOMAIN), 1);
    assert_eq!(client.codes("p.pddl", Some(1)), [""; 0]);
    tell(&mut client, Some(&DOMAIN.replace("lit", "lti")), 2);
    assert_eq!(client.codes("p.pddl", Some(1)), ["E0202"]);
    tell(&mut client, None, 3);
    assert_eq!(client.codes("p.pddl", Some(1)), ["E0212"]);
    assert_eq!(client.end(), 0);
}

#[test]
fn folders_that_are_opened_and_closed() {
    let mut client = begin(&[("more/d.pddl", &DOMAIN.replace("hall", "elsewhere"))]);
    // Outside the folder that is open: the server has not read it.
    let other = tempfile::tempdir().unwrap();
    std::fs::write(other.path().join("d.pddl"), DOMAIN).unwrap();
    let folder = json!({"uri": format!("file://{}", other.path().display()), "name": "other"});
    client.open("p.pddl", PROBLEM);
    assert_eq!(client.codes("p.pddl", Some(1)), ["E0212"]);
    let change = |added: &[_], removed: &[_]| json!({"event": {"added": added, "removed": removed}});
    client.tell("workspace/didChangeWorkspaceFolders", change(std::slice::from_ref(&folder), &[]));
    assert_eq!(client.codes("p.pddl", Some(1)), [""; 0]);
    client.tell("workspace/didChangeWorkspaceFolders", change(&[], &[folder]));
    assert_eq!(client.codes("p.pddl", Some(1)), ["E0212"]);
    assert_eq!(client.end(), 0);
}

#[test]
fn limits_are_said() {
    let files = [("a.pddl", DOMAIN), ("b.pddl", DOMAIN), ("c.pddl", DOMAIN), ("d/e.pddl", DOMAIN)];
    let mut client = Client::begin_with(&files, &json!({"maxFiles": 2, "maxFileBytes": 30}), &["utf-16"]);
    let said = client.wait(|m| m["method"] == "window/showMessage");
    assert!(said["params"]["message"].as_str().unwrap().contains("larger than 30 bytes"));
    assert_eq!(client.end(), 0);
    let mut client = Client::begin_with(&files, &json!({"maxFiles": 2}), &["utf-16"]);
    let said = client.wait(|m| m["method"] == "window/showMessage");
    assert!(said["params"]["message"].as_str().unwrap().contains("at most 2 files"));
    assert_eq!(client.end(), 0);
}

#[test]
fn documents_that_are_no_files() {
    let mut client = begin(&[]);
    client.tell("textDocument/didOpen", json!({"textDocument":
        {"uri": "untitled:Untitled-1", "languageId": "pddl", "version": 1, "text": "(define (domain d) (:types a - b"}}));
    let said = client.wait(|m| m["method"] == "textDocument/publishDiagnostics");
    assert_eq!(said["params"]["uri"], "untitled:Untitled-1");
    assert_ne!(said["params"]["diagnostics"], json!([]));
    assert_eq!(client.end(), 0);
}

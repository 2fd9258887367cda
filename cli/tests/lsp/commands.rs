//! `pelea.plan` and `pelea.validate`.

use crate::client::Client;
use serde_json::{Value, json};

const DOMAIN: &str = "(define (domain hall)\n  (:predicates (lit) (open))\n  (:action enter :parameters () :precondition (and) :effect (open))\n  (:action switch :parameters () :precondition (open) :effect (lit)))\n";
const PROBLEM: &str = "(define (problem dark)\n  (:domain hall)\n  (:init)\n  (:goal (lit)))\n";

fn run(client: &mut Client, command: &str, name: &str) -> Result<Value, Value> {
    let uri = client.uri(name);
    client.ask("workspace/executeCommand", json!({"command": command, "arguments": [uri]}))
}

#[test]
fn a_plan_is_made_and_put_beside_its_problem() {
    let mut client = Client::begin(&[("d.pddl", DOMAIN), ("p.pddl", PROBLEM)]);
    client.open("p.pddl", PROBLEM);
    let result = run(&mut client, "pelea.plan", "p.pddl").unwrap();
    assert_eq!(
        (&result["outcome"], &result["steps"], &result["cost"]),
        (&json!("solved"), &json!(2), &json!("2"))
    );
    assert_eq!(result["plan"], client.uri("p.plan"));
    let edit = client.wait(|m| m["method"] == "workspace/applyEdit");
    let changes = &edit["params"]["edit"]["documentChanges"];
    assert_eq!((&changes[0]["kind"], &changes[0]["uri"]), (&json!("create"), &json!(client.uri("p.plan"))));
    assert!(changes[1]["edits"][0]["newText"].as_str().unwrap().starts_with("(enter)\n(switch)\n"));
    // The editor writes; the server does not.
    assert!(!client.is_file("p.plan"));
    assert_eq!(client.end(), 0);
}

#[test]
fn a_problem_without_a_plan_says_why_until_it_changes() {
    let mut client = Client::begin_with(&[("d.pddl", DOMAIN)], &json!({"lints": false}), &["utf-16"]);
    let hopeless = PROBLEM.replace("(lit)))", "(and (lit) (not (open)))))");
    client.open("p.pddl", &hopeless);
    let result = run(&mut client, "pelea.plan", "p.pddl").unwrap();
    assert_eq!(result["outcome"], "unsolvable", "{result}");
    let wrong = client.wait(|m| {
        m["method"] == "textDocument/publishDiagnostics" && m.to_string().contains("there is no plan")
    });
    assert_eq!(wrong["params"]["diagnostics"][0]["range"]["start"]["line"], 3);
    client.change("p.pddl", 2, &json!([{"text": PROBLEM}]));
    assert_eq!(client.codes("p.pddl", Some(2)), [""; 0]);
    assert_eq!(client.end(), 0);
}

#[test]
fn a_verdict_stands_at_the_step_that_fails() {
    let mut client = Client::begin(&[("d.pddl", DOMAIN), ("p.pddl", PROBLEM)]);
    client.open("p.plan", "(enter)\n(switch)\n");
    let result = run(&mut client, "pelea.validate", "p.plan").unwrap();
    assert_eq!(result, json!({"verdict": "valid", "steps": 2, "cost": "2"}));
    client.change("p.plan", 2, &json!([{"text": "; too early\n(switch)\n(enter)\n"}]));
    let result = run(&mut client, "pelea.validate", "p.plan").unwrap();
    assert_eq!(result["verdict"], "not-valid");
    let wrong = client.wait(|m| {
        m["method"] == "textDocument/publishDiagnostics"
            && m["params"]["version"] == 2
            && m["params"]["diagnostics"] != json!([])
    });
    let diagnostic = &wrong["params"]["diagnostics"][0];
    assert_eq!(diagnostic["range"]["start"]["line"], 1, "{diagnostic}");
    assert_eq!(diagnostic["message"], result["message"]);
    assert_eq!(client.end(), 0);
}

#[test]
fn what_cannot_be_planned_for_is_said() {
    let mut client = Client::begin(&[("d.pddl", DOMAIN)]);
    client.open("p.pddl", &PROBLEM.replace("(lit)))", "(lti)))"));
    let result = run(&mut client, "pelea.plan", "p.pddl").unwrap();
    assert_eq!(result["outcome"], "refused");
    for (command, name) in [("pelea.plan", "d.pddl"), ("pelea.validate", "d.pddl")] {
        assert_eq!(run(&mut client, command, name).unwrap_err()["code"], -32803);
    }
    assert_eq!(run(&mut client, "pelea.plan", "no.pddl").unwrap_err()["code"], -32602);
    assert_eq!(client.end(), 0);
}

/// A puzzle that no search solves while this test runs: sorting many places by exchanging neighbours.
fn endless() -> (String, String) {
    let domain = "(define (domain exchange) (:requirements :typing) (:types place thing)
      (:predicates (at ?t - thing ?p - place) (beside ?p ?q - place))
      (:action exchange :parameters (?a ?b - thing ?p ?q - place)
        :precondition (and (beside ?p ?q) (at ?a ?p) (at ?b ?q))
        :effect (and (not (at ?a ?p)) (not (at ?b ?q)) (at ?a ?q) (at ?b ?p))))";
    let all = |prefix: &str| (0..60).map(|i| format!(" {prefix}{i}")).collect::<String>();
    let facts: String = (0..60).map(|i| format!(" (at t{i} p{i}) (beside p{i} p{})", (i + 1) % 60)).collect();
    let goal: String = (0..60).map(|i| format!(" (at t{i} p{})", i * 7 % 60)).collect();
    let problem = format!(
        "(define (problem many) (:domain exchange) (:objects{} - thing{} - place) (:init{facts}) (:goal (and{goal})))",
        all("t"),
        all("p")
    );
    (domain.to_owned(), problem)
}

#[test]
fn planning_can_be_stopped_and_blocks_no_other_request() {
    let (domain, problem) = endless();
    let mut client = Client::begin(&[("d.pddl", &domain)]);
    client.open("p.pddl", &problem);
    let uri = client.uri("p.pddl");
    let id = client.request("workspace/executeCommand", json!({"command": "pelea.plan", "arguments": [uri]}));
    client
        .wait(|m| m["params"]["value"]["title"].as_str().is_some_and(|title| title.starts_with("planning")));
    assert_eq!(client.ask_at("textDocument/hover", "no.pddl", 0, 0), Ok(Value::Null));
    client.tell("$/cancelRequest", json!({"id": id}));
    assert_eq!(client.answer(id).unwrap_err()["code"], -32800);
    // And by the button of the progress.
    let id = client.request("workspace/executeCommand", json!({"command": "pelea.plan", "arguments": [uri]}));
    let begun =
        client.wait(|m| m["params"]["value"]["title"].as_str().is_some_and(|t| t.starts_with("planning")));
    client.tell("window/workDoneProgress/cancel", json!({"token": begun["params"]["token"]}));
    assert_eq!(client.answer(id).unwrap_err()["code"], -32800);
    assert_eq!(client.end(), 0);
}

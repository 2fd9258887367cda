//! Malformed and unknown messages: the session continues.

use crate::client::{Client, framed};
use serde_json::{Value, json};

#[test]
fn garbage_is_answered_and_passed_over() {
    let mut client = Client::begin(&[]);
    for garbage in [
        &b"Content-Type: x\r\n\r\n"[..],
        b"GET / HTTP/1.1\r\nHost: x\r\n\r\n",
        b"Content-Length: twelve\r\n\r\n",
        b"Content-Length: 99999999999999\r\n\r\n",
        b"Content-Length: 3\r\n\r\n{]\xff",
        b"Content-Length: 2\r\n\r\n[]",
        b"Content-Length: 25\r\n\r\n{\"id\":1.5,\"method\":\"moin\"}",
    ] {
        client.write(garbage);
        let answer = client.wait(|m| m.get("error").is_some());
        assert_eq!(answer["id"], Value::Null);
        let code = answer["error"]["code"].as_i64().unwrap();
        assert!([-32700, -32600].contains(&code), "{answer}");
    }
    assert_eq!(client.end(), 0);
}

#[test]
fn unknown_methods() {
    let mut client = Client::begin(&[]);
    let refused = client.ask("textDocument/moonPhase", json!({})).unwrap_err();
    assert_eq!(refused["code"], -32601);
    client.tell("textDocument/didMoonRise", json!({}));
    client.tell("$/whatever", json!([1]));
    let refused = client.ask("textDocument/hover", json!({"textDocument": 3})).unwrap_err();
    assert_eq!(refused["code"], -32602);
    let refused = client.ask("workspace/executeCommand", json!({"command": "rm"})).unwrap_err();
    assert_eq!(refused["code"], -32602);
    // What cannot be read, and answers to what was never asked.
    client.tell("textDocument/didChange", json!({"textDocument": null}));
    client.tell("textDocument/didOpen", json!(null));
    client.tell("textDocument/didClose", json!({"textDocument": {"uri": "file:///nobody/knows"}}));
    client.change("never-opened.pddl", 1, &json!([{"text": ""}]));
    client.send(&json!({"jsonrpc": "2.0", "id": 4711, "result": null}));
    client.send(&json!({"jsonrpc": "2.0", "id": "x", "error": {"code": 1, "message": "no"}}));
    for method in ["hover", "definition", "completion", "documentHighlight", "prepareRename"] {
        let answer = client.ask_at(&format!("textDocument/{method}"), "no.pddl", 0, 0);
        assert!(answer.is_ok_and(|answer| answer.is_null() || answer == json!([])), "{method}");
    }
    assert_eq!(client.end(), 0);
}

#[test]
fn messages_in_pieces() {
    let mut client = Client::silent(&[]);
    let request = json!({"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": {"capabilities": {}}});
    for byte in framed(&request) {
        client.write(&[byte]);
    }
    assert!(client.answer(1).is_ok());
    // And two in one piece, with a third that begins in it.
    let hover = |id: i32| {
        framed(&json!({"jsonrpc": "2.0", "id": id, "method": "textDocument/hover",
        "params": {"textDocument": {"uri": "file:///x"}, "position": {"line": 0, "character": 0}}}))
    };
    let mut bytes = [hover(2), hover(3), hover(4)].concat();
    let rest = bytes.split_off(bytes.len() - 17);
    client.write(&bytes);
    assert_eq!(client.answer(3), Ok(Value::Null));
    client.write(&rest);
    assert_eq!(client.answer(4), Ok(Value::Null));
    assert_eq!(client.answer(2), Ok(Value::Null));
    assert_eq!(client.end(), 0);
}

#[test]
fn the_end_in_the_middle_of_a_message() {
    let mut client = Client::begin(&[]);
    client.write(b"Content-Length: 500\r\n\r\n{\"jsonrpc\"");
    client.hang_up();
    assert_eq!(client.code(), 1);
}

//! A panic anywhere is caught, logged and answered, and the session goes on.

#![allow(clippy::unwrap_used, reason = "a test")]

use lsp::{Disk, Ended, Entry, Host, Judged, PlanOptions, Planned, ReadError, Task, Tools, serve};
use serde_json::{Value, json};
use std::io::{Cursor, Write};
use std::sync::{Arc, Mutex};

struct Clumsy;

impl Disk for Clumsy {
    fn list(&self, _: &str) -> Vec<Entry> {
        panic!("fell over a folder")
    }
    fn read(&self, _: &str, _: u64) -> Result<String, ReadError> {
        panic!("fell over a file")
    }
}

impl Tools for Clumsy {
    fn plan(&self, _: &Task, _: &PlanOptions) -> Planned {
        panic!("fell over a plan")
    }
    fn validate(&self, _: &Task, _: &pddl::Source) -> Judged {
        Judged::Unreadable
    }
}

#[derive(Clone, Default)]
struct Output(Arc<Mutex<Vec<u8>>>);

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_panic_is_caught_and_the_session_goes_on() {
    let uri = "file:///a/d.pddl";
    let messages = [
        json!({"jsonrpc": "2.0", "id": 1, "method": "initialize",
            "params": {"capabilities": {}, "rootUri": "file:///a"}}),
        json!({"jsonrpc": "2.0", "method": "initialized", "params": {}}),
        json!({"jsonrpc": "2.0", "method": "workspace/didChangeWatchedFiles",
            "params": {"changes": [{"uri": uri, "type": 2}]}}),
        json!({"jsonrpc": "2.0", "id": 2, "method": "textDocument/hover",
            "params": {"textDocument": {"uri": uri}, "position": {"line": 0, "character": 0}}}),
        json!({"jsonrpc": "2.0", "id": 3, "method": "shutdown"}),
        json!({"jsonrpc": "2.0", "method": "exit"}),
    ];
    let input: String = messages
        .iter()
        .map(Value::to_string)
        .map(|body| format!("Content-Length: {}\r\n\r\n{body}", body.len()))
        .collect();
    let output = Output::default();
    let host = Host { disk: Arc::new(Clumsy), tools: Arc::new(Clumsy) };
    assert_eq!(serve(Cursor::new(input), output.clone(), host), Ended::Properly);
    let said = String::from_utf8(output.0.lock().unwrap().clone()).unwrap();
    assert!(said.contains("a bug in pelea: fell over a file"), "{said}");
    for id in 1..=3 {
        assert!(said.contains(&format!("\"id\":{id},\"result\"")), "{said}");
    }
}

//! Any bytes as what an editor sends: the text of an open file, then messages, one a line, from the first line that
//! starts with a brace.
#![no_main]

use std::io::Cursor;
use std::sync::Arc;

use lsp::{Disk, Ended, Entry, Host, Judged, PlanOptions, Planned, ReadError, Task, Tools};
use pddl::Source;

/// A computer without files and programs.
struct Nothing;

impl Disk for Nothing {
    fn list(&self, _folder: &str) -> Vec<Entry> {
        Vec::new()
    }

    fn read(&self, _path: &str, _max_bytes: u64) -> Result<String, ReadError> {
        Err(ReadError::Unreadable("no such file".into()))
    }
}

impl Tools for Nothing {
    fn plan(&self, _task: &Task, _options: &PlanOptions) -> Planned {
        Planned::Unreadable
    }

    fn validate(&self, _task: &Task, _plan: &Source) -> Judged {
        Judged::Unreadable
    }
}

const HELLO: [&str; 2] = [
    r#"{"jsonrpc":"2.0","id":0,"method":"initialize","params":{"capabilities":{}}}"#,
    r#"{"jsonrpc":"2.0","method":"initialized","params":{}}"#,
];

const GOODBYE: [&str; 2] =
    [r#"{"jsonrpc":"2.0","id":"last","method":"shutdown"}"#, r#"{"jsonrpc":"2.0","method":"exit"}"#];

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let input = String::from_utf8_lossy(bytes);
    let at = if input.starts_with('{') { 0 } else { input.find("\n{").map_or(input.len(), |at| at + 1) };
    let (text, messages) = input.split_at(at);
    let open = serde_json::json!({"jsonrpc": "2.0", "method": "textDocument/didOpen", "params": {
        "textDocument": {"uri": "file:///d.pddl", "languageId": "pddl", "version": 1, "text": text}
    }});
    let mut session = String::new();
    let open = open.to_string();
    for body in HELLO.into_iter().chain([open.as_str()]).chain(messages.lines()).chain(GOODBYE) {
        session += &format!("Content-Length: {}\r\n\r\n{body}", body.len());
    }
    let host = Host { disk: Arc::new(Nothing), tools: Arc::new(Nothing) };
    let ended = lsp::serve(Cursor::new(session.into_bytes()), std::io::sink(), host);
    assert!(ended == Ended::Properly || messages.contains("exit") || messages.contains("\\u"));
});

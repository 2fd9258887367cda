//! A minimal client: it writes messages, and reads until the expected message has come.
//!
//! It has no clock. A test that waits for a message that never comes hangs until the runner's time limit. When the server
//! ends, the client reports the message that it waited for.

use serde_json::{Value, json};
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use tempfile::TempDir;

/// A server and the folder that it works in.
pub(crate) struct Client {
    server: Child,
    input: Option<ChildStdin>,
    output: BufReader<ChildStdout>,
    folder: TempDir,
    next: i64,
    /// Messages that came while the client waited for another.
    kept: VecDeque<Value>,
}

impl Client {
    /// A server that has received no message, in a folder with these files.
    pub(crate) fn silent(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        for (name, text) in files {
            let path = folder.path().join(name);
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(path, text).unwrap();
        }
        let mut server = Command::new(env!("CARGO_BIN_EXE_pelea"))
            .arg("lsp")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        let input = server.stdin.take();
        let output = BufReader::new(server.stdout.take().unwrap());
        Self { server, input, output, folder, next: 1, kept: VecDeque::new() }
    }

    /// A session that has begun, with a client that can do everything, in UTF-16; the folder has been read.
    pub(crate) fn begin(files: &[(&str, &str)]) -> Self {
        Self::begin_with(files, &json!({}), &["utf-16"])
    }

    /// The same with options and encodings.
    pub(crate) fn begin_with(files: &[(&str, &str)], options: &Value, encodings: &[&str]) -> Self {
        let mut client = Self::silent(files);
        let root = client.uri("");
        let params = json!({
            "processId": null, "rootUri": root, "initializationOptions": options,
            "workspaceFolders": [{"uri": root, "name": "here"}],
            "capabilities": {
                "general": {"positionEncodings": encodings},
                "window": {"workDoneProgress": true},
                "workspace": {"applyEdit": true, "didChangeWatchedFiles": {"dynamicRegistration": true},
                    "workspaceEdit": {"documentChanges": true, "resourceOperations": ["create"]}},
                "textDocument": {
                    "hover": {"contentFormat": ["markdown"]},
                    "documentSymbol": {"hierarchicalDocumentSymbolSupport": true},
                    "publishDiagnostics": {"relatedInformation": true},
                    "codeAction": {"codeActionLiteralSupport": {}},
                    "completion": {"completionItem": {"snippetSupport": true}},
                },
            },
        });
        client.ask("initialize", params).unwrap();
        client.tell("initialized", json!({}));
        client.wait(|m| m["method"] == "$/progress" && m["params"]["value"]["kind"] == "end");
        client
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// The URI of a file in the folder, percent-encoded where it must be.
    pub(crate) fn uri(&self, name: &str) -> String {
        let path = if name.is_empty() { self.folder.path().to_owned() } else { self.path(name) };
        let mut uri = "file://".to_owned();
        for byte in path.to_str().unwrap().bytes() {
            match byte {
                b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' => {
                    uri.push(char::from(byte));
                }
                _ => uri.push_str(&format!("%{byte:02X}")),
            }
        }
        uri
    }

    /// Bytes as they are.
    pub(crate) fn write(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes).unwrap();
        input.flush().unwrap();
    }

    /// A message.
    pub(crate) fn send(&mut self, message: &Value) {
        self.write(&framed(message));
    }

    /// A notification.
    pub(crate) fn tell(&mut self, method: &str, params: impl Into<Value>) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params.into()}));
    }

    /// A request, without waiting for its answer.
    pub(crate) fn request(&mut self, method: &str, params: impl Into<Value>) -> i64 {
        let id = self.next;
        self.next += 1;
        self.send(&json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params.into()}));
        id
    }

    /// The answer to a request: its result, or its error.
    pub(crate) fn answer(&mut self, id: i64) -> Result<Value, Value> {
        let answer = self.wait(|m| m["id"] == id && m.get("method").is_none());
        match answer.get("error") {
            Some(error) => Err(error.clone()),
            None => Ok(answer["result"].clone()),
        }
    }

    /// A request and its answer.
    pub(crate) fn ask(&mut self, method: &str, params: impl Into<Value>) -> Result<Value, Value> {
        let id = self.request(method, params);
        self.answer(id)
    }

    /// The first message like that, kept or to come. Requests of the server are answered on the way.
    pub(crate) fn wait(&mut self, like: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&like) {
            return self.kept.remove(at).unwrap();
        }
        loop {
            let message = self.read().expect("the server ended, and something was still to come");
            if let (Some(id), Some(method)) = (message.get("id"), message.get("method")) {
                let result =
                    if method == "workspace/applyEdit" { json!({"applied": true}) } else { Value::Null };
                self.send(&json!({"jsonrpc": "2.0", "id": id, "result": result}));
            }
            if like(&message) {
                return message;
            }
            self.kept.push_back(message);
        }
    }

    /// The next message; nothing if the server has ended.
    fn read(&mut self) -> Option<Value> {
        let mut length = 0;
        loop {
            let mut line = String::new();
            if self.output.read_line(&mut line).unwrap() == 0 {
                return None;
            }
            if line == "\r\n" {
                break;
            }
            if let Some(bytes) = line.strip_prefix("Content-Length: ") {
                length = bytes.trim().parse().unwrap();
            }
        }
        let mut body = vec![0; length];
        self.output.read_exact(&mut body).unwrap();
        let message: Value = serde_json::from_slice(&body).unwrap();
        assert_eq!(message["jsonrpc"], "2.0");
        Some(message)
    }

    pub(crate) fn open(&mut self, name: &str, text: &str) {
        let uri = self.uri(name);
        self.tell(
            "textDocument/didOpen",
            json!({"textDocument": {"uri": uri, "languageId": "pddl", "version": 1, "text": text}}),
        );
    }

    pub(crate) fn change(&mut self, name: &str, version: i64, changes: &Value) {
        let uri = self.uri(name);
        self.tell(
            "textDocument/didChange",
            json!({"textDocument": {"uri": uri, "version": version}, "contentChanges": changes}),
        );
    }

    /// The diagnostics of a document, as published next for that version (or for a closed document).
    pub(crate) fn diagnostics(&mut self, name: &str, version: Option<i64>) -> Vec<Value> {
        let uri = self.uri(name);
        let message = self.wait(|m| {
            m["method"] == "textDocument/publishDiagnostics"
                && m["params"]["uri"] == uri.as_str()
                && m["params"].get("version").and_then(Value::as_i64) == version
        });
        message["params"]["diagnostics"].as_array().unwrap().clone()
    }

    /// The codes of its diagnostics.
    pub(crate) fn codes(&mut self, name: &str, version: Option<i64>) -> Vec<String> {
        let codes = self.diagnostics(name, version);
        codes.iter().map(|d| d["code"].as_str().unwrap_or("none").to_owned()).collect()
    }

    /// A question about a place.
    pub(crate) fn ask_at(
        &mut self,
        method: &str,
        name: &str,
        line: u32,
        character: u32,
    ) -> Result<Value, Value> {
        let uri = self.uri(name);
        self.ask(method, json!({"textDocument": {"uri": uri}, "position": super::position(line, character)}))
    }

    /// Ends the session as the protocol requires, and returns the exit code.
    pub(crate) fn end(mut self) -> i32 {
        assert_eq!(self.ask("shutdown", Value::Null), Ok(Value::Null));
        self.tell("exit", Value::Null);
        self.code()
    }

    /// The exit code of a server that ends by itself.
    pub(crate) fn code(mut self) -> i32 {
        while self.read().is_some() {}
        self.server.wait().unwrap().code().unwrap()
    }

    /// Closes the pipe to the server.
    pub(crate) fn hang_up(&mut self) {
        self.input = None;
    }

    pub(crate) fn is_file(&self, name: &str) -> bool {
        Path::is_file(&self.path(name))
    }
}

/// A message in its frame.
pub(crate) fn framed(message: &Value) -> Vec<u8> {
    let body = message.to_string();
    format!("Content-Length: {}\r\n\r\n{body}", body.len()).into_bytes()
}

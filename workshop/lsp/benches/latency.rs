//! How long an author waits: an edit in a problem of 5,000 lines, until the client has the answer.
//!
//! The measurement covers bytes in, threads, the loop and bytes out; only the process is missing. Lints run
//! after each question too, as they do when an author pauses.

#![allow(clippy::unwrap_used, missing_docs, reason = "a bench")]

use criterion::{Criterion, criterion_group, criterion_main};
use lsp::{Disk, Entry, Host, Judged, PlanOptions, Planned, ReadError, Task, Tools, serve};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::hint::black_box;
use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Read, Write};
use std::sync::Arc;

struct Nothing;

impl Disk for Nothing {
    fn list(&self, _: &str) -> Vec<Entry> {
        Vec::new()
    }
    fn read(&self, _: &str, _: u64) -> Result<String, ReadError> {
        Err(ReadError::Unreadable("there is no disk".to_owned()))
    }
}

impl Tools for Nothing {
    fn plan(&self, _: &Task, _: &PlanOptions) -> Planned {
        Planned::Unreadable
    }
    fn validate(&self, _: &Task, _: &pddl::Source) -> Judged {
        Judged::Unreadable
    }
}

const DOMAIN: &str = "(define (domain depots)
  (:requirements :strips :typing)
  (:types place crate truck - object)
  (:predicates (at ?c - crate ?p - place) (parked ?t - truck ?p - place) (in ?c - crate ?t - truck)
    (road ?from ?to - place))
  (:action drive :parameters (?t - truck ?from ?to - place)
    :precondition (and (parked ?t ?from) (road ?from ?to))
    :effect (and (not (parked ?t ?from)) (parked ?t ?to)))
  (:action load :parameters (?c - crate ?t - truck ?p - place)
    :precondition (and (at ?c ?p) (parked ?t ?p))
    :effect (and (not (at ?c ?p)) (in ?c ?t)))
  (:action unload :parameters (?c - crate ?t - truck ?p - place)
    :precondition (and (in ?c ?t) (parked ?t ?p))
    :effect (and (not (in ?c ?t)) (at ?c ?p))))
";

/// 5,000 lines: 400 objects, 4,220 facts, 190 goals.
fn problem() -> String {
    let mut text = "(define (problem many)\n  (:domain depots)\n  (:objects\n".to_owned();
    for i in 0..200 {
        writeln!(text, "    place{i} - place\n    crate{i} - crate").unwrap();
    }
    text.push_str("    truck - truck)\n  (:init\n    (parked truck place0)\n");
    for i in 0..4020 {
        writeln!(text, "    (road place{} place{})", i % 200, (i * 7 + i / 200) % 200).unwrap();
    }
    for i in 0..200 {
        writeln!(text, "    (at crate{i} place{})", i * 3 % 200).unwrap();
    }
    text.push_str("  )\n  (:goal (and\n");
    for i in 0..190 {
        writeln!(text, "    (at crate{i}\n      place{})", i * 11 % 200).unwrap();
    }
    text.push_str("  )))\n");
    text
}

struct Client {
    input: PipeWriter,
    output: BufReader<PipeReader>,
    version: i64,
}

impl Client {
    fn begin() -> Self {
        let (server_input, input) = std::io::pipe().unwrap();
        let (output, server_output) = std::io::pipe().unwrap();
        std::thread::spawn(move || {
            let host = Host { disk: Arc::new(Nothing), tools: Arc::new(Nothing) };
            serve(server_input, server_output, host)
        });
        let mut client = Self { input, output: BufReader::new(output), version: 1 };
        client.send(&json!({"jsonrpc": "2.0", "id": 0, "method": "initialize",
            "params": {"capabilities": {"textDocument": {"codeAction": {"codeActionLiteralSupport": {}}}}}}));
        client.read();
        client.tell("initialized", &json!({}));
        for (name, text) in [("d.pddl", DOMAIN.to_owned()), ("p.pddl", problem())] {
            let document =
                json!({"uri": format!("file:///b/{name}"), "languageId": "pddl", "version": 1, "text": text});
            client.tell("textDocument/didOpen", &json!({"textDocument": document}));
        }
        client.diagnostics();
        client
    }

    fn send(&mut self, message: &Value) {
        let body = message.to_string();
        write!(self.input, "Content-Length: {}\r\n\r\n{body}", body.len()).unwrap();
    }

    fn tell(&mut self, method: &str, params: &Value) {
        self.send(&json!({"jsonrpc": "2.0", "method": method, "params": params}));
    }

    fn read(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            self.output.read_line(&mut line).unwrap();
            match line.strip_prefix("Content-Length: ") {
                Some(bytes) => length = bytes.trim().parse().unwrap(),
                None if line == "\r\n" => break,
                None => {}
            }
        }
        let mut body = vec![0; length];
        self.output.read_exact(&mut body).unwrap();
        serde_json::from_slice(&body).unwrap()
    }

    /// Makes a name in the middle wrong, or right again.
    fn edit(&mut self) {
        self.version += 1;
        let name = if self.version % 2 == 0 { "roda" } else { "road" };
        let range = json!({"start": {"line": 2500, "character": 5}, "end": {"line": 2500, "character": 9}});
        let document = json!({"uri": "file:///b/p.pddl", "version": self.version});
        let params = json!({"textDocument": document, "contentChanges": [{"range": range, "text": name}]});
        self.tell("textDocument/didChange", &params);
    }

    /// What is wrong with the problem as it is now.
    fn diagnostics(&mut self) -> Value {
        loop {
            let message = self.read();
            if message["params"]["uri"] == "file:///b/p.pddl" && message["params"]["version"] == self.version
            {
                return message;
            }
        }
    }

    fn ask(&mut self, method: &str, mut params: Value) -> Value {
        params["textDocument"] = json!({"uri": "file:///b/p.pddl"});
        self.send(&json!({"jsonrpc": "2.0", "id": self.version, "method": method, "params": params}));
        loop {
            let message = self.read();
            if message.get("id").is_some() {
                assert!(message.get("error").is_none(), "{message}");
                return message;
            }
        }
    }
}

fn latency(c: &mut Criterion) {
    assert!(problem().lines().count() >= 5_000);
    let mut group = c.benchmark_group("5,000 lines");
    group.sample_size(30);
    let mut client = Client::begin();
    group.bench_function("edit, diagnostics", |b| {
        b.iter(|| {
            client.edit();
            client.diagnostics()
        });
    });
    let at = json!({"position": {"line": 2600, "character": 12}});
    for (name, params) in [
        ("hover", &at),
        ("completion", &at),
        ("signatureHelp", &at),
        ("definition", &at),
        ("documentHighlight", &at),
        ("documentSymbol", &json!({})),
        ("semanticTokens/full", &json!({})),
        ("codeLens", &json!({})),
        (
            "codeAction",
            &json!({"range": {"start": {"line": 2600, "character": 12}, "end": {"line": 2600, "character": 12}}, "context": {"diagnostics": []}}),
        ),
        ("formatting", &json!({"options": {"tabSize": 2, "insertSpaces": true}})),
    ] {
        let mut client = Client::begin();
        group.bench_function(format!("edit, {name}"), |b| {
            b.iter(|| {
                client.edit();
                black_box(client.ask(&format!("textDocument/{name}"), params.clone()))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, latency);
criterion_main!(benches);

//! `pelea dsr export`: the whole history as MCAP, with JSON messages and their schemas.
//!
//! Two channels: `/dsr/state` has the state with which the journal begins and the one after each gap, `/dsr/commit` every
//! commit with its sentences and changes. Log times are those of the commits.

use super::{Failed, open, seconds};
use crate::console::Console;
use crate::exit::Exit;
use ::mcap::records::MessageHeader;
use ::mcap::{WriteOptions, Writer};
use clap::Args;
use dsr::{Change, Played, Recording, Snapshot};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

/// Arguments of `pelea dsr export`.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// A journal: the folder of `pelea run --journal`, or a file in it.
    journal: PathBuf,
    /// Where the MCAP file goes.
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

/// A commit as a message.
#[derive(Serialize)]
struct Commit<'a> {
    version: u64,
    time: f64,
    writer: &'a str,
    sentences: Vec<String>,
    changes: &'a [Change],
}

const COMMIT: &str = r#"{"title": "dsr.Commit", "type": "object", "required": ["version", "time", "writer", "sentences", "changes"],
 "properties": {
  "version": {"type": "integer"}, "time": {"type": "number", "description": "seconds"}, "writer": {"type": "string"},
  "sentences": {"type": "array", "items": {"type": "string"}},
  "changes": {"type": "array", "items": {"type": "object"}}}}"#;

const STATE: &str = r#"{"title": "dsr.State", "type": "object", "required": ["version", "time", "nodes", "edges", "transforms"],
 "properties": {
  "version": {"type": "integer"}, "time": {"type": "integer", "description": "nanoseconds"}, "next": {"type": "integer"},
  "nodes": {"type": "array", "items": {"type": "object", "required": ["id", "name", "type", "since"], "properties": {
    "id": {"type": "integer"}, "name": {"type": "string"}, "type": {"type": "string"}, "since": {"type": "integer"},
    "attributes": {"type": "array", "items": {"type": "object"}}}}},
  "edges": {"type": "array", "items": {"type": "object", "required": ["from", "label", "to", "since"], "properties": {
    "from": {"type": "string"}, "label": {"type": "string"}, "to": {"type": "string"}, "since": {"type": "integer"},
    "attributes": {"type": "array", "items": {"type": "object"}}}}},
  "transforms": {"type": "array", "items": {"type": "object", "required": ["parent", "child", "translation", "rotation"],
   "properties": {
    "parent": {"type": "string"}, "child": {"type": "string"}, "since": {"type": "integer"},
    "translation": {"type": "array", "items": {"type": "number"}},
    "rotation": {"type": "array", "items": {"type": "number"}},
    "samples": {"type": "array", "items": {"type": "object"}}}}}}}"#;

pub(super) fn run(arguments: &Arguments, console: &mut Console<'_>) -> Result<Exit, Failed> {
    let (recording, exit) = open(&arguments.journal, console)?;
    let written = write(&recording, &arguments.output)?;
    console.note(&format!("{written} messages written to `{}`", arguments.output.display()));
    Ok(exit)
}

fn write(recording: &Recording, path: &Path) -> Result<u64, Failed> {
    let failed = |error: ::mcap::McapError| {
        Failed(Exit::Unwritable, format!("cannot write `{}`: {error}", path.display()))
    };
    let file = File::create(path).map_err(|error| failed(error.into()))?;
    let options = WriteOptions::new().compression(None).profile("").library("pelea");
    let mut writer = options.create(BufWriter::new(file)).map_err(failed)?;
    let mut channel = |name: &str, topic: &str, schema: &str| {
        let schema = writer.add_schema(name, "jsonschema", schema.as_bytes())?;
        writer.add_channel(schema, topic, "json", &BTreeMap::new())
    };
    let states = channel("dsr.State", "/dsr/state", STATE).map_err(failed)?;
    let commits = channel("dsr.Commit", "/dsr/commit", COMMIT).map_err(failed)?;

    let mut count = 0;
    let mut replay = recording.replay()?;
    put(&mut writer, states, &replay.snapshot(), &replay.snapshot().export(), &mut count).map_err(failed)?;
    while let Some(played) = replay.next() {
        let snapshot = replay.snapshot();
        match played? {
            Played::Jump { .. } => put(&mut writer, states, &snapshot, &snapshot.export(), &mut count),
            Played::Commit(delta) => {
                let commit = Commit {
                    version: delta.version.0,
                    time: seconds(delta.time),
                    writer: super::writer(recording, &delta),
                    sentences: delta.sentences(&snapshot),
                    changes: &delta.changes,
                };
                put(&mut writer, commits, &snapshot, &commit, &mut count)
            }
        }
        .map_err(failed)?;
    }
    writer.finish().map_err(failed)?;
    Ok(count)
}

fn put(
    writer: &mut Writer<BufWriter<File>>,
    channel_id: u16,
    snapshot: &Snapshot,
    message: &impl Serialize,
    count: &mut u64,
) -> ::mcap::McapResult<()> {
    let time = snapshot.time().0;
    // The format's counter wraps, too.
    let sequence = u32::try_from(*count % (1 << 32)).unwrap_or_default();
    let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
    *count += 1;
    let bytes = serde_json::to_vec(message).map_err(std::io::Error::from)?;
    writer.write_to_known_channel(&header, &bytes)
}

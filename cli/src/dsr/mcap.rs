//! `pelea dsr export`: the whole history as MCAP, with JSON messages and their schemas.
//!
//! `/dsr/state` has the state with which the journal begins and the one after each gap, `/dsr/commit` every commit with its
//! sentences, changes and reflexes. `/tf` has the poses and `/dsr/log` the sentences once more, as Foxglove shows them
//! (`foxglove`). Log times are those of the commits.

use super::foxglove::{LOG, Log, TRANSFORMS, Transforms};
use super::{Failed, Told, open};
use crate::console::Console;
use crate::exit::Exit;
use ::mcap::records::MessageHeader;
use ::mcap::{WriteOptions, Writer};
use clap::Args;
use dsr::{Delta, Played, Recording, Snapshot, Time};
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

const COMMIT: &str = r#"{"title": "dsr.Commit", "type": "object",
 "required": ["version", "time", "writer", "sentences", "changes", "reflexes"],
 "properties": {
  "version": {"type": "integer"}, "time": {"type": "number", "description": "seconds"}, "writer": {"type": "string"},
  "sentences": {"type": "array", "items": {"type": "string"}},
  "changes": {"type": "array", "items": {"type": "object"}},
  "reflexes": {"type": "array", "items": {"type": "integer"}, "description": "those that fired"}}}"#;

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
    let mut output = File::create(path).map_err(Into::into).and_then(Output::new).map_err(failed)?;
    let mut replay = recording.replay()?;
    output.state(&replay.snapshot()).map_err(failed)?;
    while let Some(played) = replay.next() {
        let snapshot = replay.snapshot();
        match played? {
            Played::Jump { .. } => output.state(&snapshot),
            Played::Commit(delta) => {
                output.commit(&delta, &Told::new(recording, &delta, &snapshot), &snapshot)
            }
        }
        .map_err(failed)?;
    }
    output.writer.finish().map_err(failed)?;
    Ok(output.count)
}

/// The file, with its channels.
struct Output {
    writer: Writer<BufWriter<File>>,
    states: u16,
    commits: u16,
    frames: u16,
    logs: u16,
    count: u64,
}

impl Output {
    fn new(file: File) -> ::mcap::McapResult<Self> {
        let options = WriteOptions::new().compression(None).profile("").library("pelea");
        let mut writer = options.create(BufWriter::new(file))?;
        let mut channel = |topic: &str, (name, schema): (&str, &str)| {
            let schema = writer.add_schema(name, "jsonschema", schema.as_bytes())?;
            writer.add_channel(schema, topic, "json", &BTreeMap::new())
        };
        let states = channel("/dsr/state", ("dsr.State", STATE))?;
        let commits = channel("/dsr/commit", ("dsr.Commit", COMMIT))?;
        let (frames, logs) = (channel("/tf", TRANSFORMS)?, channel("/dsr/log", LOG)?);
        Ok(Self { writer, states, commits, frames, logs, count: 0 })
    }

    fn state(&mut self, snapshot: &Snapshot) -> ::mcap::McapResult<()> {
        let time = snapshot.time();
        self.put(self.states, time, &snapshot.export())?;
        Transforms::of_state(snapshot).map_or(Ok(()), |frames| self.put(self.frames, time, &frames))
    }

    fn commit(&mut self, delta: &Delta, told: &Told<'_>, snapshot: &Snapshot) -> ::mcap::McapResult<()> {
        self.put(self.commits, delta.time, told)?;
        self.put(self.logs, delta.time, &Log::of_commit(delta, &told.sentences, told.writer))?;
        let moved = Transforms::of_commit(delta, snapshot);
        moved.map_or(Ok(()), |frames| self.put(self.frames, delta.time, &frames))
    }

    fn put(&mut self, channel_id: u16, Time(time): Time, message: &impl Serialize) -> ::mcap::McapResult<()> {
        // The format's counter wraps, too.
        let sequence = u32::try_from(self.count % (1 << 32)).unwrap_or_default();
        let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
        self.count += 1;
        let bytes = serde_json::to_vec(message).map_err(std::io::Error::from)?;
        self.writer.write_to_known_channel(&header, &bytes)
    }
}

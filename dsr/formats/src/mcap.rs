//! A whole recording as MCAP, with JSON messages and their schemas.
//!
//! The channel `/dsr/state` has the state with which the recording begins, and the state after each gap. `/dsr/commit`
//! has every commit with its sentences, changes and reflexes. `/tf` has the poses and `/dsr/log` the sentences once
//! more, in the schemas that Foxglove shows by itself (module `foxglove`). A message has the time of its commit.

use std::collections::BTreeMap;
use std::io::{Seek, Write};

use dsr::{Delta, Played, Recording, RecordingError, Snapshot, Time};
use mcap::WriteOptions;
use mcap::records::MessageHeader;
use serde::Serialize;

use crate::commit::CommitRecord;
use crate::foxglove::{LOG, Log, TRANSFORMS, Transforms};

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

/// Why a recording was not written.
#[derive(Debug, thiserror::Error)]
pub enum McapWriteError {
    /// The recording cannot be read to its end.
    #[error(transparent)]
    Recording(#[from] RecordingError),
    /// The output failed.
    #[error(transparent)]
    Mcap(#[from] mcap::McapError),
}

/// Writes the recording and returns the number of messages.
pub fn write_mcap(recording: &Recording, output: impl Write + Seek) -> Result<u64, McapWriteError> {
    let mut output = Output::new(output)?;
    let mut replay = recording.replay()?;
    output.state(&replay.snapshot())?;
    while let Some(played) = replay.next() {
        let snapshot = replay.snapshot();
        match played? {
            Played::Jump { .. } => output.state(&snapshot)?,
            Played::Commit(delta) => {
                output.commit(&delta, &CommitRecord::new(recording, &delta, &snapshot), &snapshot)?;
            }
        }
    }
    output.writer.finish()?;
    Ok(output.count)
}

/// The output, with its channels.
struct Output<W: Write + Seek> {
    writer: mcap::Writer<W>,
    states: u16,
    commits: u16,
    frames: u16,
    logs: u16,
    count: u64,
}

impl<W: Write + Seek> Output<W> {
    fn new(output: W) -> mcap::McapResult<Self> {
        let options = WriteOptions::new().compression(None).profile("").library("pelea");
        let mut writer = options.create(output)?;
        let mut channel = |topic: &str, (name, schema): (&str, &str)| {
            let schema = writer.add_schema(name, "jsonschema", schema.as_bytes())?;
            writer.add_channel(schema, topic, "json", &BTreeMap::new())
        };
        let states = channel("/dsr/state", ("dsr.State", STATE))?;
        let commits = channel("/dsr/commit", ("dsr.Commit", COMMIT))?;
        let (frames, logs) = (channel("/tf", TRANSFORMS)?, channel("/dsr/log", LOG)?);
        Ok(Self { writer, states, commits, frames, logs, count: 0 })
    }

    fn state(&mut self, snapshot: &Snapshot) -> mcap::McapResult<()> {
        let time = snapshot.time();
        self.put(self.states, time, &snapshot.export())?;
        Transforms::of_state(snapshot).map_or(Ok(()), |frames| self.put(self.frames, time, &frames))
    }

    fn commit(
        &mut self,
        delta: &Delta,
        record: &CommitRecord<'_>,
        snapshot: &Snapshot,
    ) -> mcap::McapResult<()> {
        self.put(self.commits, delta.time, record)?;
        self.put(self.logs, delta.time, &Log::of_commit(delta, &record.sentences, record.writer))?;
        let moved = Transforms::of_commit(delta, snapshot);
        moved.map_or(Ok(()), |frames| self.put(self.frames, delta.time, &frames))
    }

    fn put(&mut self, channel_id: u16, Time(time): Time, message: &impl Serialize) -> mcap::McapResult<()> {
        // The format's counter wraps, too.
        let sequence = u32::try_from(self.count % (1 << 32)).unwrap_or_default();
        let header = MessageHeader { channel_id, sequence, log_time: time, publish_time: time };
        self.count += 1;
        let bytes = serde_json::to_vec(message).map_err(std::io::Error::from)?;
        self.writer.write_to_known_channel(&header, &bytes)
    }
}

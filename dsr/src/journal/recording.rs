//! Reading a journal: which versions it has, and each of them, to the byte.
//!
//! Opening a recording checks all bytes and keeps none of those from files: a segment is read again for a version in
//! it. A fault is a [`Damage`] with its place; everything before it stays readable, and so do the following segments.
//!
//! Invariant: versions rise. If a segment ends with the version with which the next one begins, it ends with the
//! same state. The history is the one that ends in the newest segment. A program that begins anew in the same
//! folder, or continues from an older version, begins another history; the segments that do not lead to the
//! newest one are reported and left out, and can be read alone. One case is not detected: a segment that ends
//! before the next one begins, because it is damaged or because commits were left out, may belong to another
//! history with the same vocabulary. Nothing can be read in between that could tell; a replay reports a
//! [`Played::Jump`](super::Played::Jump) there.
//!
//! Cost: opening is one pass over the bytes, and a replay of each segment that another program has continued. A version
//! costs its segment's state and the deltas up to it.

use std::io;
use std::path::Path;
use std::sync::Arc;

use super::error::{Damage, RecordingError};
use super::playback::{Played, Replay};
use super::reader::Reader;
use super::segment::{Segment, Source};
use super::store::{self, Stage};
use crate::graph::Graph;
use crate::id::{Time, Version};
use crate::snapshot::Snapshot;
use crate::vocabulary::Vocabulary;

/// How often a folder is listed again if all its segments were deleted between listing and reading them.
const TRIES: u32 = 8;

/// A journal, for reading.
#[derive(Debug)]
pub struct Recording {
    vocabulary: Arc<Vocabulary>,
    segments: Vec<Segment>,
    damage: Vec<Damage>,
}

impl Recording {
    /// Reads the file of a segment, or a folder of them. A journal may delete segments meanwhile.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RecordingError> {
        let path = path.as_ref();
        let unreadable = |error| RecordingError::Unreadable { path: path.to_owned(), error };
        let mut tries = 0;
        loop {
            let is_folder = path.is_dir();
            let files = if is_folder {
                store::segments(path).map_err(unreadable)?
            } else {
                vec![(Stage::Part, path.to_owned())]
            };
            let (mut reader, mut gone) = (Reader::default(), false);
            for (stage, path) in files {
                let name = path.to_string_lossy();
                match std::fs::read(&path) {
                    Ok(bytes) => reader.segment(&name, stage, &bytes, || Source::File(path.clone())),
                    Err(error) if !is_folder => return Err(unreadable(error)),
                    Err(error) if error.kind() == io::ErrorKind::NotFound => {
                        reader.gone();
                        gone = true;
                    }
                    Err(error) => reader.unreadable(&name, &error),
                }
            }
            tries += 1;
            match Self::of(reader) {
                // All segments may have been deleted since they were listed.
                Err(RecordingError::Empty) if gone && tries < TRIES => {}
                done => return done,
            }
        }
    }

    /// Reads segments that are in memory.
    pub fn read(segments: impl IntoIterator<Item = Vec<u8>>) -> Result<Self, RecordingError> {
        let mut reader = Reader::default();
        for (number, bytes) in segments.into_iter().enumerate() {
            // A deleted segment of a `Memory` is empty.
            if !bytes.is_empty() {
                let name = format!("segment {number}");
                reader.segment(&name, Stage::Part, &bytes, || Source::Bytes(bytes.clone()));
            }
        }
        Self::of(reader)
    }

    fn of(reader: Reader) -> Result<Self, RecordingError> {
        let (segments, damage) = reader.done();
        let Some(newest) = segments.last() else {
            // Damage of the disk explains more than the leftovers of a crash.
            let told = |damage: &Damage| match damage {
                Damage::Corrupt { .. } | Damage::Short { .. } | Damage::Unreadable { .. } => 0,
                Damage::Format { .. } => 1,
                _ => 2,
            };
            // A file with only a torn end may be any file.
            let known = damage
                .into_iter()
                .filter(|damage| !matches!(damage, Damage::Torn { .. } | Damage::Foreign { .. }));
            let first = known.min_by_key(told);
            return Err(first.map_or(RecordingError::Empty, |damage| RecordingError::Damaged { damage }));
        };
        Ok(Self { vocabulary: Arc::clone(&newest.vocabulary), segments, damage })
    }

    /// The vocabulary of the graph.
    pub fn vocabulary(&self) -> &Arc<Vocabulary> {
        &self.vocabulary
    }

    /// The faults that were found.
    pub fn damage(&self) -> &[Damage] {
        &self.damage
    }

    /// The oldest version, and its time.
    pub fn first(&self) -> (Version, Time) {
        self.segments.first().map_or_else(Default::default, |segment| segment.first)
    }

    /// The newest version, and its time.
    pub fn last(&self) -> (Version, Time) {
        self.segments.last().map_or_else(Default::default, |segment| segment.last)
    }

    /// The state at a version.
    pub fn at(&self, version: Version) -> Result<Snapshot, RecordingError> {
        Ok(self.replayed(version)?.snapshot())
    }

    /// The state at the newest version whose commit has this time or an earlier one. Committers give the times, which
    /// need not rise with the versions: an older version may have a later time.
    pub fn at_time(&self, time: Time) -> Result<Snapshot, RecordingError> {
        for (at, segment) in self.segments.iter().enumerate().rev() {
            let early = |earliest: &Option<Time>| earliest.is_some_and(|earliest| earliest <= time);
            let Some(frame) = segment.earliest.iter().rposition(early) else { continue };
            let mut replay = Replay::new(&self.segments, at)?;
            if let Some(version) = replay.newest(frame, time)? {
                replay.advance(version)?;
                return Ok(replay.snapshot());
            }
        }
        let times = self.segments.iter().flat_map(|segment| segment.earliest.iter().flatten());
        Err(RecordingError::NoTime { asked: time, earliest: times.min().copied().unwrap_or_default() })
    }

    /// Replays all versions, from the oldest on.
    pub fn replay(&self) -> Result<Replay<'_>, RecordingError> {
        Replay::new(&self.segments, 0)
    }

    /// Replays the versions from this one on, or from the next recorded one.
    pub fn replay_from(&self, version: Version) -> Result<Replay<'_>, RecordingError> {
        let mut replay = Replay::new(&self.segments, self.find(version)?)?;
        replay.advance(version)?;
        Ok(replay)
    }

    /// A graph that continues from the newest version, with the reflexes that were registered in it: each fires when
    /// its owner expires.
    pub fn resume(&self) -> Result<Graph, RecordingError> {
        self.resume_at(self.last().0)
    }

    /// A graph that continues from a version, with the reflexes that were registered in it.
    pub fn resume_at(&self, version: Version) -> Result<Graph, RecordingError> {
        let mut replay = self.replayed(version)?;
        replay.settle()?;
        Ok(replay.resume())
    }

    /// A graph that goes through the recorded versions again, from the oldest to `until`, and continues from there as
    /// [`Recording::resume_at`] does. `each` is called at the first version and after each one, so it can subscribe and
    /// follow the whole history. After a gap it is called with another graph, at the version after the gap.
    pub fn relive(&self, until: Version, mut each: impl FnMut(&Graph)) -> Result<Graph, RecordingError> {
        self.find(until)?;
        let mut replay = self.replay()?;
        let mut graph = Graph::from_snapshot(&replay.snapshot());
        each(&graph);
        while replay.version() < until {
            match replay.next().transpose()? {
                Some(Played::Commit(delta)) => {
                    let misfit =
                        |error| RecordingError::Misfit { segment: "the history".into(), offset: 0, error };
                    graph.follow(delta).map_err(misfit)?;
                }
                Some(Played::Jump { .. }) => graph = Graph::from_snapshot(&replay.snapshot()),
                None => break,
            }
            each(&graph);
        }
        if replay.version() != until {
            let (first, last) = (self.first().0, self.last().0);
            return Err(RecordingError::NoVersion { asked: until, first, last });
        }
        replay.settle()?;
        replay.hand_over(&graph);
        Ok(graph)
    }

    /// A replay that stands at this version.
    fn replayed(&self, version: Version) -> Result<Replay<'_>, RecordingError> {
        let segment = self.find(version)?;
        let (before, next) = (self.segments[segment].last.0, self.segments.get(segment + 1));
        if let (true, Some(next)) = (before < version, next) {
            return Err(RecordingError::NotRecorded { asked: version, before, next: next.first.0 });
        }
        let mut replay = Replay::new(&self.segments, segment)?;
        replay.advance(version)?;
        Ok(replay)
    }

    /// The last segment that begins at this version or before it, if the recording reaches it.
    fn find(&self, version: Version) -> Result<usize, RecordingError> {
        let (first, last) = (self.first().0, self.last().0);
        let found = self.segments.iter().rposition(|segment| segment.first.0 <= version);
        found.filter(|_| version <= last).ok_or(RecordingError::NoVersion { asked: version, first, last })
    }
}

//! Reading a journal: which versions it has, and each of them, to the byte.
//!
//! A recording checks all bytes when it is opened and keeps none of files: a segment is read again for a version that
//! lies in it. What cannot be read is a [`Damage`] with its place, and everything before it, and from the next segment
//! on, stays readable.
//!
//! Invariant: in a recording versions rise, and where a segment ends with the version with which the next begins, it
//! ends with its state. The history is the one that ends in the newest segment: who begins anew, or goes on from an
//! older version, in the same folder begins another, and the segments that do not lead to the newest are named, left
//! out, and can be read alone. What is not seen: a segment that ends before the next begins may be of another history
//! with the same vocabulary; nothing was recorded in between by which to tell, and a replay shows a
//! [`Played::Jump`](super::Played::Jump) there.
//!
//! Cost: opening is one pass over the bytes, and a replay of the segments that meet, one at a time; a version is its
//! segment's state and the deltas up to it.

use std::io;
use std::path::Path;
use std::sync::Arc;

use super::error::{Damage, RecordingError};
use super::playback::Replay;
use super::reader::Reader;
use super::segment::{Segment, Source};
use super::store;
use crate::graph::Graph;
use crate::id::{Time, Version};
use crate::snapshot::Snapshot;
use crate::vocabulary::Vocabulary;

/// How often a folder is looked at again whose segments were all let go of between its names and their bytes.
const TRIES: u32 = 8;

/// A journal that was written.
#[derive(Debug)]
pub struct Recording {
    vocabulary: Arc<Vocabulary>,
    segments: Vec<Segment>,
    damage: Vec<Damage>,
}

impl Recording {
    /// Reads a segment's file, or a folder of them. A journal that lets go of segments meanwhile does not disturb it.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RecordingError> {
        let path = path.as_ref();
        let unreadable = |error| RecordingError::Unreadable { path: path.to_owned(), error };
        let mut tries = 0;
        loop {
            let is_folder = path.is_dir();
            let files =
                if is_folder { store::segments(path).map_err(unreadable)? } else { vec![path.to_owned()] };
            let (mut reader, mut gone) = (Reader::default(), false);
            for path in files {
                let name = path.to_string_lossy();
                match std::fs::read(&path) {
                    Ok(bytes) => reader.segment(&name, &bytes, || Source::File(path.clone())),
                    Err(error) if !is_folder => return Err(unreadable(error)),
                    Err(error) if error.kind() == io::ErrorKind::NotFound => gone = true,
                    Err(error) => reader.unreadable(&name, &error),
                }
            }
            tries += 1;
            match Self::of(reader) {
                // All that there was may have been let go of since the names were read.
                Err(RecordingError::Empty) if gone && tries < TRIES => {}
                done => return done,
            }
        }
    }

    /// Reads segments that are in memory.
    pub fn read(segments: impl IntoIterator<Item = Vec<u8>>) -> Result<Self, RecordingError> {
        let mut reader = Reader::default();
        for (number, bytes) in segments.into_iter().enumerate() {
            // One of a `Memory` that was let go of.
            if !bytes.is_empty() {
                reader.segment(&format!("segment {number}"), &bytes, || Source::Bytes(bytes.clone()));
            }
        }
        Self::of(reader)
    }

    fn of(reader: Reader) -> Result<Self, RecordingError> {
        let (segments, damage) = reader.done();
        let Some(newest) = segments.last() else {
            // What became of the disk says more than what a crash left.
            let told = |damage: &Damage| match damage {
                Damage::Corrupt { .. } | Damage::Unreadable { .. } => 0,
                Damage::Format { .. } => 1,
                _ => 2,
            };
            // A file with nothing but a torn end may be anything.
            let known = damage.into_iter().filter(|damage| !matches!(damage, Damage::Torn { .. }));
            let first = known.min_by_key(told);
            return Err(first.map_or(RecordingError::Empty, |damage| RecordingError::Damaged { damage }));
        };
        Ok(Self { vocabulary: Arc::clone(&newest.vocabulary), segments, damage })
    }

    /// The vocabulary of the graph.
    pub fn vocabulary(&self) -> &Arc<Vocabulary> {
        &self.vocabulary
    }

    /// What could not be read.
    pub fn damage(&self) -> &[Damage] {
        &self.damage
    }

    /// The oldest version there is, and its time.
    pub fn first(&self) -> (Version, Time) {
        self.segments.first().map_or_else(Default::default, |segment| segment.first)
    }

    /// The newest version there is, and its time.
    pub fn last(&self) -> (Version, Time) {
        self.segments.last().map_or_else(Default::default, |segment| segment.last)
    }

    /// The state at a version.
    pub fn at(&self, version: Version) -> Result<Snapshot, RecordingError> {
        let segment = self.find(version)?;
        let (before, next) = (self.segments[segment].last.0, self.segments.get(segment + 1));
        if let (true, Some(next)) = (before < version, next) {
            return Err(RecordingError::NotRecorded { asked: version, before, next: next.first.0 });
        }
        let mut replay = Replay::new(&self.segments, segment)?;
        replay.advance(version)?;
        Ok(replay.snapshot())
    }

    /// The newest version that was committed at a time or before, as a state. Times are those that committers gave;
    /// versions order, not they, so there may be a version before it that was committed later.
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

    /// All versions from the oldest on.
    pub fn replay(&self) -> Result<Replay<'_>, RecordingError> {
        Replay::new(&self.segments, 0)
    }

    /// All versions from this one on, or from the next one if it was not recorded.
    pub fn replay_from(&self, version: Version) -> Result<Replay<'_>, RecordingError> {
        let mut replay = Replay::new(&self.segments, self.find(version)?)?;
        replay.advance(version)?;
        Ok(replay)
    }

    /// A graph that goes on from the newest version.
    pub fn resume(&self) -> Result<Graph, RecordingError> {
        Ok(Graph::from_snapshot(&self.at(self.last().0)?))
    }

    /// The last segment that begins at a version or before, if there is one as late.
    fn find(&self, version: Version) -> Result<usize, RecordingError> {
        let (first, last) = (self.first().0, self.last().0);
        let found = self.segments.iter().rposition(|segment| segment.first.0 <= version);
        found.filter(|_| version <= last).ok_or(RecordingError::NoVersion { asked: version, first, last })
    }
}

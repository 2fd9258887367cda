//! Reading a journal: which versions it has, and each of them, to the byte.
//!
//! A recording checks all bytes when it is opened and keeps none of files: a segment is read again for a version that
//! lies in it. What cannot be read is a [`Damage`] with its place, and everything before it, and from the next segment
//! on, stays readable.
//!
//! Invariant: in a recording versions rise, and where a segment ends with the version with which the next begins, it ends
//! with its state. The history is the one that ends in the newest segment: who begins anew, or goes on from an older version,
//! in the same folder begins another, and the segments that do not lead to the newest are named, left out, and can be read
//! alone. What is not seen: a segment that ends before the next begins may be of another history with the same vocabulary;
//! nothing was recorded in between by which to tell, and a replay shows a [`Played::Jump`](super::Played::Jump) there.
//!
//! Cost: opening is one pass over the bytes, and a replay of the segments that meet, one at a time; a version is its segment's
//! state and the deltas up to it.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::playback::Replay;
use super::segment::{Reader, Segment, Source};
use super::store;
use crate::graph::Graph;
use crate::id::{Time, Version};
use crate::replay::ReplayError;
use crate::snapshot::Snapshot;
use crate::vocabulary::Vocabulary;

/// How often a folder is looked at again whose segments were all let go of between its names and their bytes.
const TRIES: u32 = 8;

/// Why there is nothing to read, or not that.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum RecordingError {
    /// A file or a folder that cannot be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Unreadable { path: PathBuf, error: io::Error },
    /// There is no segment, or nothing that begins as one.
    #[error("no state of a journal")]
    Empty,
    /// No segment has a state that can be read; the damage that says most about why.
    #[error("{damage}; there is no state that can be read")]
    Damaged { damage: Damage },
    /// The journal has no such version.
    #[error("no version {}: there are versions {} to {}", asked.0, first.0, last.0)]
    NoVersion { asked: Version, first: Version, last: Version },
    /// The journal has versions before and after it.
    #[error("version {} was not recorded: version {} follows on {}", asked.0, next.0, before.0)]
    NotRecorded { asked: Version, before: Version, next: Version },
    /// Everything was committed after that time.
    #[error("nothing was recorded at {} ns or before: the earliest state is of {} ns", asked.0, earliest.0)]
    NoTime { asked: Time, earliest: Time },
    /// Bytes with a right checksum that do not continue what was before them.
    #[error("`{segment}`, byte {offset}: {error}")]
    Misfit { segment: Arc<str>, offset: usize, error: ReplayError },
    /// A file is no longer what it was when the recording was opened.
    #[error("`{segment}` changed while it was read")]
    Changed { segment: Arc<str> },
}

/// What cannot be read of a segment, or why it is left out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum Damage {
    /// What was being written when the process or the machine stopped. It was never durable.
    #[error("`{segment}` ends in a torn record at byte {offset}: {bytes} bytes cut")]
    Torn { segment: Arc<str>, offset: usize, bytes: usize },
    /// What was on the disk is no longer what it was.
    #[error("`{segment}` is corrupt at byte {offset}; what follows in it cannot be read")]
    Corrupt { segment: Arc<str>, offset: usize },
    /// It was being begun when the process or the machine stopped, or is so at this moment.
    #[error("`{segment}` ends before its state does: there is nothing to read in it")]
    Unfinished { segment: Arc<str> },
    /// It is of a graph with other tokens than the newest segment.
    #[error("`{segment}` has another vocabulary than the segments behind it and is left out")]
    OtherDictionary { segment: Arc<str> },
    /// Who wrote the segments behind it did not go on from its end.
    #[error("`{segment}` goes to version {}, the segments behind it begin at {}: it is of another history \
        and left out", last.0, next.0)]
    OtherHistory { segment: Arc<str>, last: Version, next: Version },
    /// A segment of another format.
    #[error("`{segment}` has format {format}, which this program does not know")]
    Format { segment: Arc<str>, format: u32 },
    /// A file that the system does not give.
    #[error("cannot read `{segment}`: {error}")]
    Unreadable { segment: Arc<str>, error: io::ErrorKind },
}

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

    /// The newest version that was committed at a time or before, as a state. Times are those that committers gave; versions
    /// order, not they, so there may be a version before it that was committed later.
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

//! Reading a journal: which versions it has, and each of them, to the byte.
//!
//! A recording checks all bytes when it is opened and keeps none of files: a segment is read again for a version that
//! lies in it. What cannot be read is a [`Damage`] with its place, and everything before it, and from the next segment
//! on, stays readable.
//!
//! Cost: opening is one pass over the bytes; a version is its segment's state and the deltas up to it.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::frame::{self, Flaw, Frame, Kind};
use super::record::{self, Gathered, Malformed};
use super::store;
use crate::delta::Delta;
use crate::dictionary::Dictionary;
use crate::export;
use crate::graph::Graph;
use crate::id::{Time, Version};
use crate::replay::{self, ReplayError};
use crate::snapshot::Snapshot;
use crate::state::State;

/// Why there is nothing to read, or not that.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum RecordingError {
    /// A file or a folder that cannot be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Unreadable { path: PathBuf, error: io::Error },
    /// There is no segment, or none with a whole state.
    #[error("no state of a journal")]
    Empty,
    /// A segment of another format.
    #[error("`{segment}` has format {format}, which this program does not know")]
    Format { segment: Arc<str>, format: u32 },
    /// A segment of a graph with other tokens.
    #[error("`{segment}` has another dictionary than the segments before it")]
    OtherDictionary { segment: Arc<str> },
    /// The journal has no such version.
    #[error("no version {}: there are versions {} to {}", asked.0, first.0, last.0)]
    NoVersion { asked: Version, first: Version, last: Version },
    /// The journal has versions before and after it.
    #[error("version {} was not recorded: version {} follows on {}", asked.0, next.0, before.0)]
    NotRecorded { asked: Version, before: Version, next: Version },
    /// Everything was committed after that time.
    #[error("nothing was recorded at {} ns or before: the first state is of {} ns", asked.0, first.0)]
    NoTime { asked: Time, first: Time },
    /// Bytes with a right checksum that do not continue what was before them.
    #[error("`{segment}`, byte {offset}: {error}")]
    Misfit { segment: Arc<str>, offset: usize, error: ReplayError },
    /// A file is no longer what it was when the recording was opened.
    #[error("`{segment}` changed while it was read")]
    Changed { segment: Arc<str> },
}

/// What cannot be read of a segment, from a byte on.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum Damage {
    /// What was being written when the process or the machine stopped. It was never durable.
    #[error("`{segment}` ends in a torn record at byte {offset}: {bytes} bytes cut")]
    Torn { segment: Arc<str>, offset: usize, bytes: usize },
    /// What was on the disk is no longer what it was.
    #[error("`{segment}` is corrupt at byte {offset}; what follows in it cannot be read")]
    Corrupt { segment: Arc<str>, offset: usize },
}

#[derive(Debug)]
enum Source {
    Bytes(Vec<u8>),
    File(PathBuf),
}

#[derive(Debug)]
struct Segment {
    name: Arc<str>,
    source: Source,
    frames: Vec<Frame>,
    /// Version and time of its state.
    first: (Version, Time),
    /// Version and time of its last delta.
    last: (Version, Time),
}

impl Segment {
    fn bytes(&self) -> Result<Cow<'_, [u8]>, RecordingError> {
        match &self.source {
            Source::Bytes(bytes) => Ok(bytes.into()),
            Source::File(path) => Ok(read(path)?.into()),
        }
    }
}

fn read(path: &Path) -> Result<Vec<u8>, RecordingError> {
    std::fs::read(path).map_err(|error| RecordingError::Unreadable { path: path.to_owned(), error })
}

/// A journal that was written.
#[derive(Debug)]
pub struct Recording {
    dictionary: Arc<Dictionary>,
    segments: Vec<Segment>,
    damage: Vec<Damage>,
}

impl Recording {
    /// Reads a segment's file, or a folder of them.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, RecordingError> {
        let path = path.as_ref();
        let unreadable = |error| RecordingError::Unreadable { path: path.to_owned(), error };
        let files = if path.is_dir() {
            store::segments(path).map_err(unreadable)?.into_iter().map(|(_, path)| path).collect()
        } else {
            vec![path.to_owned()]
        };
        let mut reader = Reader::default();
        for path in files {
            let bytes = read(&path)?;
            reader.segment(&path.to_string_lossy(), &bytes, || Source::File(path.clone()))?;
        }
        reader.done()
    }

    /// Reads segments that are in memory.
    pub fn read(segments: impl IntoIterator<Item = Vec<u8>>) -> Result<Self, RecordingError> {
        let mut reader = Reader::default();
        for (number, bytes) in segments.into_iter().enumerate() {
            reader.segment(&format!("segment {number}"), &bytes, || Source::Bytes(bytes.clone()))?;
        }
        reader.done()
    }

    /// The dictionary of the graph.
    pub fn dictionary(&self) -> &Arc<Dictionary> {
        &self.dictionary
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
        let (first, last) = (self.first().0, self.last().0);
        let mut replay = match self.begin(|segment| segment.first.0 <= version) {
            Some(replay) if version <= last => replay?,
            _ => return Err(RecordingError::NoVersion { asked: version, first, last }),
        };
        loop {
            let before = replay.version();
            if before == version {
                return Ok(replay.snapshot());
            }
            match replay.next() {
                Some(Ok(_)) if replay.version() <= version => {}
                Some(Err(error)) => return Err(error),
                _ => {
                    let next = replay.version();
                    return Err(RecordingError::NotRecorded { asked: version, before, next });
                }
            }
        }
    }

    /// The newest state that was committed at a time or before. Times are those that committers gave.
    pub fn at_time(&self, time: Time) -> Result<Snapshot, RecordingError> {
        let none = || RecordingError::NoTime { asked: time, first: self.first().1 };
        let mut replay = self.begin(|segment| segment.first.1 <= time).ok_or_else(none)??;
        loop {
            let snapshot = replay.peek_time()?.is_none_or(|next| next > time).then(|| replay.snapshot());
            if let Some(snapshot) = snapshot {
                return Ok(snapshot);
            }
            if let Some(Err(error)) = replay.next() {
                return Err(error);
            }
        }
    }

    /// All versions from the oldest on.
    pub fn replay(&self) -> Result<Replay<'_>, RecordingError> {
        Replay::new(self, 0)
    }

    /// All versions from this one on.
    pub fn replay_from(&self, version: Version) -> Result<Replay<'_>, RecordingError> {
        let (first, last) = (self.first().0, self.last().0);
        let Some(replay) = self.begin(|segment| segment.first.0 <= version) else {
            return Err(RecordingError::NoVersion { asked: version, first, last });
        };
        let mut replay = replay?;
        while replay.version() < version {
            replay.next().ok_or(RecordingError::NoVersion { asked: version, first, last })??;
        }
        Ok(replay)
    }

    /// A graph that goes on from the newest version.
    pub fn resume(&self) -> Result<Graph, RecordingError> {
        Ok(Graph::from_snapshot(&self.at(self.last().0)?))
    }

    /// The replay of the last segment of which this holds.
    fn begin(&self, wanted: impl Fn(&Segment) -> bool) -> Option<Result<Replay<'_>, RecordingError>> {
        Some(Replay::new(self, self.segments.iter().rposition(wanted)?))
    }
}

#[derive(Default)]
struct Reader {
    dictionary: Option<(Arc<Dictionary>, Vec<u8>)>,
    segments: Vec<Segment>,
    damage: Vec<Damage>,
}

impl Reader {
    fn segment(
        &mut self,
        name: &str,
        bytes: &[u8],
        source: impl FnOnce() -> Source,
    ) -> Result<(), RecordingError> {
        let name: Arc<str> = name.into();
        let (mut frames, flaw) = frame::scan(bytes);
        match flaw {
            Some(Flaw::Torn(offset)) => {
                let (segment, bytes) = (name.clone(), bytes.len() - offset);
                self.damage.push(Damage::Torn { segment, offset, bytes });
            }
            Some(Flaw::Corrupt(offset)) => {
                self.damage.push(Damage::Corrupt { segment: name.clone(), offset });
            }
            None => {}
        }
        let Some((start, rest)) = frames.split_first().filter(|(start, _)| start.kind == Kind::Start) else {
            // Torn in its first frame: there is nothing, and that has been said.
            if let (Some(frame), None) = (frames.first(), flaw) {
                let (segment, offset) = (name, frame.offset);
                self.damage.push(Damage::Corrupt { segment, offset });
            }
            return Ok(());
        };
        let payload = start.payload(bytes);
        match &self.dictionary {
            Some((_, known)) if *known != payload => {
                return Err(RecordingError::OtherDictionary { segment: name });
            }
            Some(_) => {}
            None => match record::start(payload) {
                Ok(dictionary) => self.dictionary = Some((Arc::new(dictionary), payload.to_vec())),
                Err(Malformed::Format(format)) => {
                    return Err(RecordingError::Format { segment: name, format });
                }
                Err(Malformed::Bytes) => {
                    self.damage.push(Damage::Corrupt { segment: name, offset: start.offset });
                    return Ok(());
                }
            },
        }
        let mut last = None;
        let mut end = frames.len();
        for (at, frame) in rest.iter().enumerate() {
            match check(frame, last, bytes) {
                Ok(reached) => last = Some(reached),
                Err(()) => {
                    self.damage.push(Damage::Corrupt { segment: name.clone(), offset: frame.offset });
                    end = at + 1;
                    break;
                }
            }
        }
        let first = rest.first().map(|frame| record::head(frame.payload(bytes)));
        let whole = whole(&frames[1..end], bytes);
        frames.truncate(end);
        if let (Some(Ok(first)), Some(last), true) = (first, last, whole) {
            self.segments.push(Segment { name, source: source(), frames, first, last });
        }
        Ok(())
    }

    fn done(self) -> Result<Recording, RecordingError> {
        let (dictionary, _) = self.dictionary.ok_or(RecordingError::Empty)?;
        if self.segments.is_empty() {
            return Err(RecordingError::Empty);
        }
        Ok(Recording { dictionary, segments: self.segments, damage: self.damage })
    }
}

/// Version and time after a frame, if it can follow what was before.
fn check(frame: &Frame, last: Option<(Version, Time)>, bytes: &[u8]) -> Result<(Version, Time), ()> {
    let payload = frame.payload(bytes);
    match (frame.kind, last) {
        (Kind::State, None) => record::head(payload).map_err(|_| ()),
        (Kind::State, Some(last)) => Ok(last),
        (Kind::Deltas, Some((mut version, mut time))) => {
            let mut rest = payload;
            while !rest.is_empty() {
                let (delta, after) = record::delta(rest).map_err(|_| ())?;
                if Some(delta.version.0) != version.0.checked_add(1) {
                    return Err(());
                }
                (version, time, rest) = (delta.version, delta.time, after);
            }
            Ok((version, time))
        }
        _ => Err(()),
    }
}

/// Whether the state of a segment came as a whole.
fn whole(frames: &[Frame], bytes: &[u8]) -> bool {
    let states = frames.iter().take_while(|frame| frame.kind == Kind::State);
    states.last().is_some_and(|frame| record::ends(frame.payload(bytes)))
}

/// What a replay met.
#[derive(Debug, Clone, PartialEq)]
pub enum Played {
    /// A commit.
    Commit(Delta),
    /// Versions after the first up to the second that were not recorded.
    Jump {
        /// The version before.
        from: Version,
        /// The version after.
        to: Version,
    },
}

/// Goes through a recording, version by version.
#[derive(Debug)]
pub struct Replay<'r> {
    recording: &'r Recording,
    segment: usize,
    bytes: Cow<'r, [u8]>,
    /// The next frame.
    frame: usize,
    /// What is left of the present one.
    rest: std::ops::Range<usize>,
    state: Arc<State>,
}

impl<'r> Replay<'r> {
    fn new(recording: &'r Recording, segment: usize) -> Result<Self, RecordingError> {
        let found = recording.segments.get(segment).ok_or(RecordingError::Empty)?;
        let bytes = found.bytes()?;
        let changed = || RecordingError::Changed { segment: found.name.clone() };
        if found.frames.last().is_some_and(|frame| frame.end() > bytes.len()) {
            return Err(changed());
        }
        let mut gathered = Gathered::default();
        let mut frame = 1;
        while let Some(next) = found.frames.get(frame).filter(|frame| frame.kind == Kind::State) {
            gathered.take(next.payload(&bytes)).map_err(|_| changed())?;
            frame += 1;
        }
        let offset = found.frames.get(1).map_or(0, |frame| frame.offset);
        let export = gathered.whole().ok_or_else(changed)?;
        let state = export::restore(Arc::clone(&recording.dictionary), &export).map_err(|error| {
            RecordingError::Misfit { segment: found.name.clone(), offset, error: error.into() }
        })?;
        Ok(Self { recording, segment, bytes, frame, rest: 0..0, state: Arc::new(state) })
    }

    /// The version where it is.
    pub fn version(&self) -> Version {
        self.state.version
    }

    /// The state where it is.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::new(Arc::clone(&self.state))
    }

    /// Goes to the next frame if the present one is through; whether the segment has another delta.
    fn fill(&mut self) -> bool {
        let frames = self.recording.segments.get(self.segment).map_or(&[][..], |s| &s.frames);
        while self.rest.is_empty() {
            let Some(frame) = frames.get(self.frame) else { return false };
            self.rest = frame.content();
            self.frame += 1;
        }
        true
    }

    /// The time of the next version, if there is one.
    fn peek_time(&mut self) -> Result<Option<Time>, RecordingError> {
        if self.fill() {
            return Ok(Some(self.delta()?.0.time));
        }
        Ok(self.recording.segments.get(self.segment + 1).map(|segment| segment.first.1))
    }

    /// The delta at the beginning of the rest, and where the one after it begins.
    fn delta(&self) -> Result<(Delta, usize), RecordingError> {
        let rest = self.bytes.get(self.rest.clone()).unwrap_or(&[]);
        let (delta, after) = record::delta(rest).map_err(|_| RecordingError::Changed {
            segment: self.recording.segments[self.segment].name.clone(),
        })?;
        Ok((delta, self.rest.end - after.len()))
    }

    fn step(&mut self) -> Result<Option<Played>, RecordingError> {
        if self.fill() {
            let (delta, next) = self.delta()?;
            let offset = self.rest.start;
            self.rest.start = next;
            return match replay::apply(Arc::make_mut(&mut self.state), &delta) {
                Ok(()) => Ok(Some(Played::Commit(delta))),
                Err(error) => {
                    let segment = self.recording.segments[self.segment].name.clone();
                    Err(RecordingError::Misfit { segment, offset, error })
                }
            };
        }
        let from = self.version();
        if self.segment + 1 >= self.recording.segments.len() {
            return Ok(None);
        }
        *self = Self::new(self.recording, self.segment + 1)?;
        let to = self.version();
        if from == to { self.step() } else { Ok(Some(Played::Jump { from, to })) }
    }
}

/// After an error there is nothing more.
impl Iterator for Replay<'_> {
    type Item = Result<Played, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        let played = self.step().transpose();
        if matches!(played, Some(Err(_))) {
            (self.segment, self.rest) = (self.recording.segments.len(), 0..0);
        }
        played
    }
}

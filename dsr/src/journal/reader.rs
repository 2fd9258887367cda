//! Reading segments: what of each can be read, checked once, and which of them are one history.
//!
//! Problem: a file may be torn, damaged, or from another program or graph; the rest of the recording must stay
//! readable. Idea: every fault is a [`Damage`] of one segment; what the bytes of a segment cannot decide, its
//! name and the segment behind it do (see `ends`). Invariant: a segment that is kept begins with a vocabulary
//! and a whole state, and the versions of its deltas follow each other. Cost: one pass over the bytes, which
//! finds each frame and the earliest time in it; and a replay of each segment that another program has
//! continued.

use std::cmp::Ordering;
use std::io;
use std::sync::Arc;

use super::error::Damage;
use super::frame::{self, Flaw, Frame, Kind};
use super::playback;
use super::record::{self, Follows, Malformed};
use super::segment::{Segment, Source};
use super::store::Stage;
use crate::id::{Time, Version};
use crate::vocabulary::Vocabulary;

/// A segment without a whole state.
struct Begun {
    name: Arc<str>,
    stage: Stage,
    /// Bytes of the file.
    length: usize,
    /// The number of segments before it.
    before: usize,
    fault: Option<Damage>,
}

/// Collects segments and their damage.
#[derive(Default)]
pub(super) struct Reader {
    /// The vocabularies so far, as bytes and decoded; usually one.
    vocabularies: Vec<(Vec<u8>, Arc<Vocabulary>)>,
    segments: Vec<Segment>,
    begun: Vec<Begun>,
    damage: Vec<Damage>,
    /// The segment before the next one is not there: its journal has deleted it, or its fault is noted.
    absent: bool,
}

impl Reader {
    /// Notes a file that cannot be read.
    pub(super) fn unreadable(&mut self, name: &str, error: &io::Error) {
        self.damage.push(Damage::Unreadable { segment: name.into(), error: error.kind() });
        self.absent = true;
    }

    /// Notes a segment that its journal has deleted since it was listed.
    pub(super) fn gone(&mut self) {
        self.absent = true;
    }

    /// Takes the bytes of a segment. `stage` is that of its name in a folder.
    pub(super) fn segment(
        &mut self,
        name: &str,
        stage: Stage,
        bytes: &[u8],
        source: impl FnOnce() -> Source,
    ) {
        let Some(mut segment) = self.check(name, stage, bytes, source) else {
            self.absent = true;
            return;
        };
        if std::mem::take(&mut self.absent) && segment.follows == Follows::Directly {
            segment.follows = Follows::AfterGap;
        }
        self.segments.push(segment);
    }

    /// A segment that has a state; the faults of others are noted.
    fn check(
        &mut self,
        name: &str,
        stage: Stage,
        bytes: &[u8],
        source: impl FnOnce() -> Source,
    ) -> Option<Segment> {
        let name: Arc<str> = name.into();
        let (mut frames, flaw) = frame::scan(bytes);
        let fault = flaw.map(|flaw| fault(flaw, &name, bytes));
        let (before, length) = (self.segments.len(), bytes.len());
        let begun = |fault| Begun { name: name.clone(), stage, length, before, fault };
        let Some(start) = frames.first() else {
            self.begun.push(begun(fault));
            return None;
        };
        let (follows, vocabulary) = match self.start(start, bytes) {
            Ok(start) => start,
            Err(malformed) => {
                self.damage.push(match malformed {
                    Malformed::Format(format) => Damage::Format { segment: name, format },
                    Malformed::Bytes => corrupt(&name, bytes, start.offset),
                });
                return None;
            }
        };
        let mut earliest = vec![None];
        let mut at = Place::default();
        earliest.extend(frames[1..].iter().map_while(|frame| at.pass(frame, bytes)).map(Some));
        let misfit = frames.get(earliest.len()).map(|frame| corrupt(&name, bytes, frame.offset));
        let fault = misfit.or(fault);
        frames.truncate(earliest.len());
        let (true, Some(first), Some(last)) = (at.whole, at.first, at.last) else {
            self.begun.push(begun(fault));
            return None;
        };
        let source = source();
        Some(Segment { name, source, vocabulary, follows, frames, earliest, first, last, fault })
    }

    /// What precedes a segment, and the vocabulary.
    fn start(&mut self, start: &Frame, bytes: &[u8]) -> Result<(Follows, Arc<Vocabulary>), Malformed> {
        if start.kind != Kind::Start {
            return Err(Malformed::Bytes);
        }
        let (follows, vocabulary) = record::start(start.payload(bytes))?;
        Ok((follows, self.vocabulary(vocabulary)?))
    }

    fn vocabulary(&mut self, payload: &[u8]) -> Result<Arc<Vocabulary>, Malformed> {
        if let Some((_, known)) = self.vocabularies.iter().find(|(bytes, _)| bytes == payload) {
            return Ok(Arc::clone(known));
        }
        let vocabulary = Arc::new(record::vocabulary(payload)?);
        self.vocabularies.push((payload.to_vec(), Arc::clone(&vocabulary)));
        Ok(vocabulary)
    }

    /// Judges how the segments end. An end is torn only if nothing proves that what is missing had been written:
    /// a journal syncs a segment before it begins the next one; a state is synced before a file has the name of
    /// a segment; and a program that continues after a crash begins with the very version with which the torn
    /// segment ends.
    fn ends(&mut self) {
        let mut begun = std::mem::take(&mut self.begun).into_iter().peekable();
        for at in 0..=self.segments.len() {
            let goes_on = self.segments.get(at).is_some_and(Segment::goes_on);
            while let Some(Begun { name, stage, length, fault, .. }) =
                begun.next_if(|begun| begun.before == at)
            {
                let fault = fault.unwrap_or(Damage::Unfinished { segment: name });
                let was_whole = goes_on || stage == Stage::Whole;
                self.damage.push(if was_whole { lost(fault, length) } else { fault });
            }
            if let Some(segment) = self.segments.get(at) {
                let fault = end(segment, self.segments.get(at + 1));
                self.damage.extend(fault.clone());
                self.segments[at].fault = fault;
            }
        }
    }

    /// The segments of the history that ends in the newest one, and the damage of all segments.
    pub(super) fn done(mut self) -> (Vec<Segment>, Vec<Damage>) {
        self.ends();
        let mut kept: Vec<Segment> = Vec::new();
        let mut is_next = true;
        for segment in self.segments.into_iter().rev() {
            let name = segment.name.clone();
            if let Some(next) = kept.last() {
                let (last, first) = (segment.last.0, next.first.0);
                if !Arc::ptr_eq(&next.vocabulary, &segment.vocabulary) {
                    self.damage.push(Damage::OtherVocabulary { segment: name });
                    continue;
                }
                is_next = match last.cmp(&first) {
                    Ordering::Greater => false,
                    // Commits may be missing in between: left out, or in a segment that is gone.
                    _ if next.goes_on() => is_next,
                    // Another program began where this one ended. Versions of different histories may meet by chance,
                    // so the states have to; what cannot be read again is not therefore of another history.
                    Ordering::Equal => playback::leads_to(&segment, next).unwrap_or(is_next),
                    // It was longer, so it may have ended there.
                    Ordering::Less if matches!(segment.fault, Some(Damage::Corrupt { .. })) => is_next,
                    Ordering::Less => false,
                };
                if !is_next {
                    self.damage.push(Damage::OtherHistory { segment: name, last, next: first });
                    continue;
                }
            }
            kept.push(segment);
        }
        kept.reverse();
        (kept, self.damage)
    }
}

fn corrupt(segment: &Arc<str>, bytes: &[u8], offset: usize) -> Damage {
    Damage::Corrupt { segment: segment.clone(), offset, bytes: bytes.len() - offset }
}

fn fault(flaw: Flaw, segment: &Arc<str>, bytes: &[u8]) -> Damage {
    match flaw {
        Flaw::Torn(offset) => Damage::Torn { segment: segment.clone(), offset, bytes: bytes.len() - offset },
        Flaw::Corrupt(offset) => corrupt(segment, bytes, offset),
        Flaw::Foreign => Damage::Foreign { segment: segment.clone() },
    }
}

/// What is wrong with the end of a segment, before the next one that can be read.
fn end(segment: &Segment, next: Option<&Segment>) -> Option<Damage> {
    let Some(next) = next.filter(|next| Arc::ptr_eq(&next.vocabulary, &segment.vocabulary)) else {
        return segment.fault.clone();
    };
    let (last, first) = (segment.last.0, next.first.0);
    match &segment.fault {
        Some(fault) if next.goes_on() || last < first => Some(lost(fault.clone(), 0)),
        None if next.follows == Follows::Directly && last < first => {
            let offset = segment.frames.last().map_or(0, Frame::end);
            Some(Damage::Missing { segment: segment.name.clone(), offset, last, next: first })
        }
        fault => fault.clone(),
    }
}

/// What a fault is if the segment had been written further than it reads, in a file of that length.
fn lost(fault: Damage, length: usize) -> Damage {
    match fault {
        Damage::Torn { segment, offset, bytes } => Damage::Corrupt { segment, offset, bytes },
        Damage::Unfinished { segment } => Damage::Short { segment, offset: length },
        fault => fault,
    }
}

/// The position in a segment: first the frames of its state, then deltas.
#[derive(Default)]
struct Place {
    first: Option<(Version, Time)>,
    last: Option<(Version, Time)>,
    /// The state is complete.
    whole: bool,
}

impl Place {
    /// Passes a frame, if it can follow here. Returns the earliest time in it.
    fn pass(&mut self, frame: &Frame, bytes: &[u8]) -> Option<Time> {
        let payload = frame.payload(bytes);
        match frame.kind {
            Kind::State if !self.whole => {
                let is_first = self.first.is_none();
                if is_first {
                    self.first = Some(record::head(payload).ok()?);
                    self.last = self.first;
                }
                self.whole = record::ends(payload, is_first).ok()?;
                Some(self.first?.1)
            }
            Kind::Deltas | Kind::Guarded if self.whole => {
                let (mut version, mut time) = self.last?;
                let mut earliest = None;
                let (_, mut rest) = record::guards(frame.kind, payload).ok()?;
                while !rest.is_empty() {
                    let (delta, after) = record::delta(rest).ok()?;
                    // A commit that only registers or dismisses reflexes makes no version.
                    let is_silent = frame.kind == Kind::Guarded && delta.version == version;
                    if is_silent && delta.changes.is_empty() && delta.reflexes.is_empty() {
                        return after.is_empty().then_some(time);
                    }
                    if Some(delta.version.0) != version.0.checked_add(1) {
                        return None;
                    }
                    (version, time, rest) = (delta.version, delta.time, after);
                    earliest = Some(earliest.map_or(time, |earliest: Time| earliest.min(time)));
                }
                self.last = Some((version, time));
                earliest
            }
            _ => None,
        }
    }
}

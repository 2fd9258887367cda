//! Reading segments: what of each can be read, checked once, and which of them are one history.
//!
//! Problem: a file may be torn, damaged, or from another program or graph; the rest of the recording must stay
//! readable. Idea: every fault is a [`Damage`] of one segment. Invariant: a segment that is kept begins with a
//! vocabulary and a whole state, and the versions of its deltas follow each other. Cost: one pass over the bytes, which
//! finds each frame and the earliest time in it; and a replay of each segment that another program has continued.

use std::cmp::Ordering;
use std::io;
use std::sync::Arc;

use super::error::Damage;
use super::frame::{self, Flaw, Frame, Kind};
use super::playback;
use super::record::{self, Malformed};
use super::segment::{Segment, Source};
use crate::id::{Time, Version};
use crate::vocabulary::Vocabulary;

/// Collects segments and their damage.
#[derive(Default)]
pub(super) struct Reader {
    /// The vocabularies so far, as bytes and decoded; usually one.
    vocabularies: Vec<(Vec<u8>, Arc<Vocabulary>)>,
    segments: Vec<Segment>,
    damage: Vec<Damage>,
}

impl Reader {
    /// Notes a file that cannot be read.
    pub(super) fn unreadable(&mut self, name: &str, error: &io::Error) {
        self.damage.push(Damage::Unreadable { segment: name.into(), error: error.kind() });
    }

    /// Takes the bytes of a segment.
    pub(super) fn segment(&mut self, name: &str, bytes: &[u8], source: impl FnOnce() -> Source) {
        let name: Arc<str> = name.into();
        let before = self.damage.len();
        if let Some(segment) = self.check(&name, bytes, source) {
            self.segments.push(segment);
        } else if self.damage.len() == before {
            self.damage.push(Damage::Unfinished { segment: name });
        }
    }

    fn check(&mut self, name: &Arc<str>, bytes: &[u8], source: impl FnOnce() -> Source) -> Option<Segment> {
        let corrupt = |offset| Damage::Corrupt { segment: name.clone(), offset };
        let (mut frames, flaw) = frame::scan(bytes);
        match flaw {
            Some(Flaw::Torn(offset)) => {
                let (segment, bytes) = (name.clone(), bytes.len() - offset);
                self.damage.push(Damage::Torn { segment, offset, bytes });
            }
            Some(Flaw::Corrupt(offset)) => self.damage.push(corrupt(offset)),
            None => {}
        }
        let start = frames.first()?;
        if start.kind != Kind::Start {
            self.damage.push(corrupt(start.offset));
            return None;
        }
        let begun = record::start(start.payload(bytes))
            .and_then(|(goes_on, vocabulary)| Ok((goes_on, self.vocabulary(vocabulary)?)));
        let (goes_on, vocabulary) = match begun {
            Ok(begun) => begun,
            Err(Malformed::Format(format)) => {
                self.damage.push(Damage::Format { segment: name.clone(), format });
                return None;
            }
            Err(Malformed::Bytes) => {
                self.damage.push(corrupt(start.offset));
                return None;
            }
        };
        let mut earliest = vec![None];
        let mut at = Place::default();
        for frame in &frames[1..] {
            let Some(time) = at.pass(frame, bytes) else {
                self.damage.push(corrupt(frame.offset));
                break;
            };
            earliest.push(Some(time));
        }
        frames.truncate(earliest.len());
        let (first, last) = (at.first?, at.last?);
        let source = at.whole.then(source)?;
        Some(Segment { name: name.clone(), source, vocabulary, goes_on, frames, earliest, first, last })
    }

    fn vocabulary(&mut self, payload: &[u8]) -> Result<Arc<Vocabulary>, Malformed> {
        if let Some((_, known)) = self.vocabularies.iter().find(|(bytes, _)| bytes == payload) {
            return Ok(Arc::clone(known));
        }
        let vocabulary = Arc::new(record::vocabulary(payload)?);
        self.vocabularies.push((payload.to_vec(), Arc::clone(&vocabulary)));
        Ok(vocabulary)
    }

    /// The segments of the history that ends in the newest one, and the damage of all segments.
    pub(super) fn done(mut self) -> (Vec<Segment>, Vec<Damage>) {
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
                    _ if next.goes_on => is_next,
                    // Another program began where this one ended. Versions of different histories may meet by chance,
                    // so the states have to; what cannot be read again is not therefore of another history.
                    Ordering::Equal => playback::leads_to(&segment, next).unwrap_or(is_next),
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
            Kind::Deltas if self.whole => {
                let (mut version, mut time) = self.last?;
                let mut earliest = None;
                let mut rest = payload;
                while !rest.is_empty() {
                    let (delta, after) = record::delta(rest).ok()?;
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

//! Replaying a recording, version by version.
//!
//! Invariant: a replay returns what was recorded, or an error, whatever the bytes. Cost: the memory of one segment's
//! bytes and one state; each delta is decoded once.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::slice;
use std::sync::Arc;

use super::error::RecordingError;
use super::frame::Kind;
use super::record::{self, Gathered, Guards};
use super::segment::Segment;
use crate::delta::Delta;
use crate::export;
use crate::graph::Graph;
use crate::id::{ReflexId, Time, Version};
use crate::replay;
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::transaction::reflexes::Guard;

/// A step of a replay.
#[derive(Debug, Clone, PartialEq)]
pub enum Played {
    /// A commit.
    Commit(Delta),
    /// Versions that were not recorded: those after `from`, before the state at `to`.
    Jump {
        /// The version before.
        from: Version,
        /// The version after.
        to: Version,
    },
}

/// A replay of a recording, version by version.
#[derive(Debug)]
pub struct Replay<'r> {
    segments: &'r [Segment],
    segment: usize,
    bytes: Cow<'r, [u8]>,
    /// The next frame.
    frame: usize,
    /// The unread bytes of the present frame.
    rest: std::ops::Range<usize>,
    state: Arc<State>,
    /// The registered reflexes.
    guards: BTreeMap<ReflexId, Guard>,
    /// What the next commit does to them.
    next: Guards,
}

impl<'r> Replay<'r> {
    pub(super) fn new(segments: &'r [Segment], segment: usize) -> Result<Self, RecordingError> {
        let found = segments.get(segment).ok_or(RecordingError::Empty)?;
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
        let (export, guards) = gathered.whole().ok_or_else(changed)?;
        let guards = guards.into_iter().map(|guard| (guard.id, guard)).collect();
        let state = export::restore(Arc::clone(&found.vocabulary), &export).map_err(|error| {
            RecordingError::Misfit { segment: found.name.clone(), offset, error: error.into() }
        })?;
        Ok(Self {
            segments,
            segment,
            bytes,
            frame,
            rest: 0..0,
            state: Arc::new(state),
            guards,
            next: Guards::default(),
        })
    }

    /// The present version.
    pub fn version(&self) -> Version {
        self.state.version
    }

    /// The present state.
    pub fn snapshot(&self) -> Snapshot {
        Snapshot::new(Arc::clone(&self.state))
    }

    /// A graph that continues from the present state, with the reflexes that were registered in it: each fires when its
    /// owner expires.
    pub(super) fn resume(&self) -> Graph {
        Graph::resumed(&self.snapshot(), self.guards.values().cloned())
    }

    /// Gives a graph at the present state the reflexes that were registered in it.
    pub(super) fn hand_over(&self, graph: &Graph) {
        graph.take_over(self.guards.values().cloned());
    }

    /// Goes to the next frame after the end of the present one. Returns whether the segment has another delta.
    fn fill(&mut self) -> Result<bool, RecordingError> {
        let Some(segment) = self.segments.get(self.segment) else { return Ok(false) };
        while self.rest.is_empty() {
            let Some(frame) = segment.frames.get(self.frame) else { return Ok(false) };
            self.rest = frame.content();
            self.frame += 1;
            let bytes = self.bytes.get(self.rest.clone()).unwrap_or(&[]);
            let changed = |_| RecordingError::Changed { segment: segment.name.clone() };
            let (next, after) = record::guards(frame.kind, bytes).map_err(changed)?;
            self.rest.start = self.rest.end - after.len();
            self.next = next;
        }
        Ok(true)
    }

    /// The reflexes after the next commit.
    fn follow(&mut self, delta: &Delta) {
        let (registered, dismissed) = std::mem::take(&mut self.next);
        dismissed.iter().chain(&delta.reflexes).for_each(|id| _ = self.guards.remove(id));
        self.guards.extend(registered.into_iter().map(|guard| (guard.id, guard)));
    }

    /// Replays up to a version, or to the next recorded one after it. Returns false at the end of the recording.
    pub(super) fn advance(&mut self, version: Version) -> Result<bool, RecordingError> {
        while self.version() < version {
            match self.step()? {
                Some(_) => {}
                None => return Ok(false),
            }
        }
        Ok(true)
    }

    /// Takes in the commits behind the present version that made no version of their own; the reader has checked that
    /// they change nothing.
    pub(super) fn settle(&mut self) -> Result<(), RecordingError> {
        while self.fill()? {
            let (delta, next) = self.delta()?;
            if delta.version != self.version() {
                break;
            }
            self.rest.start = next;
            self.follow(&delta);
        }
        Ok(())
    }

    /// The newest version in a frame of this segment with this time or an earlier one.
    pub(super) fn newest(&self, frame: usize, time: Time) -> Result<Option<Version>, RecordingError> {
        let Some(segment) = self.segments.get(self.segment) else { return Ok(None) };
        let Some(frame) = segment.frames.get(frame) else { return Ok(None) };
        if frame.kind == Kind::State {
            return Ok((segment.first.1 <= time).then_some(segment.first.0));
        }
        let changed = |_| RecordingError::Changed { segment: segment.name.clone() };
        let bytes = self.bytes.get(frame.content()).unwrap_or(&[]);
        let ((_, mut rest), mut newest) = (record::guards(frame.kind, bytes).map_err(changed)?, None);
        while !rest.is_empty() {
            let (delta, after) = record::delta(rest).map_err(changed)?;
            if delta.time <= time {
                newest = Some(delta.version);
            }
            rest = after;
        }
        Ok(newest)
    }

    /// The next delta, and the offset of the one after it.
    fn delta(&self) -> Result<(Delta, usize), RecordingError> {
        let rest = self.bytes.get(self.rest.clone()).unwrap_or(&[]);
        let (delta, after) = record::delta(rest)
            .map_err(|_| RecordingError::Changed { segment: self.segments[self.segment].name.clone() })?;
        Ok((delta, self.rest.end - after.len()))
    }

    fn step(&mut self) -> Result<Option<Played>, RecordingError> {
        let (delta, offset) = loop {
            self.settle()?;
            if !self.rest.is_empty() {
                let (delta, next) = self.delta()?;
                break (delta, std::mem::replace(&mut self.rest.start, next));
            }
            // A journal that ends without a commit leaves a segment that begins and ends where the previous one ended;
            // there may be any number of these.
            let from = self.version();
            if self.segment + 1 >= self.segments.len() {
                return Ok(None);
            }
            *self = Self::new(self.segments, self.segment + 1)?;
            let to = self.version();
            if from != to {
                return Ok(Some(Played::Jump { from, to }));
            }
        };
        self.follow(&delta);
        match replay::apply(Arc::make_mut(&mut self.state), &delta) {
            Ok(()) => Ok(Some(Played::Commit(delta))),
            Err(error) => {
                let segment = self.segments[self.segment].name.clone();
                Err(RecordingError::Misfit { segment, offset, error })
            }
        }
    }
}

/// Whether a segment ends with the state with which another begins.
pub(super) fn leads_to(before: &Segment, after: &Segment) -> Result<bool, RecordingError> {
    // Version and time are part of the state and are known already.
    if before.last != after.first {
        return Ok(false);
    }
    let (mut before, after) =
        (Replay::new(slice::from_ref(before), 0)?, Replay::new(slice::from_ref(after), 0)?);
    before.advance(after.version())?;
    Ok(before.snapshot().export() == after.snapshot().export())
}

/// After an error the iterator ends.
impl Iterator for Replay<'_> {
    type Item = Result<Played, RecordingError>;

    fn next(&mut self) -> Option<Self::Item> {
        let played = self.step().transpose();
        if matches!(played, Some(Err(_))) {
            (self.segment, self.rest) = (self.segments.len(), 0..0);
        }
        played
    }
}

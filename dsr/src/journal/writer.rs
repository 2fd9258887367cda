//! The journal's thread: takes what waits as one group, writes it, syncs when it is time, begins segments.

use std::io;
use std::sync::Arc;
use std::time::Instant;

use super::feed::{Feed, Last, Progress, Work};
use super::frame::{self, Kind};
use super::record;
use super::store::Store;
use super::{Durability, Settings};
use crate::delta::Delta;
use crate::graph::Observed;
use crate::snapshot::Snapshot;

/// Bytes after which a frame is closed.
const FRAME: usize = 1 << 20;

pub(super) struct Writer<S> {
    pub(super) store: S,
    pub(super) settings: Settings,
    pub(super) feed: Arc<Feed>,
    pub(super) graph: Observed,
    segment: Segment,
    /// When what was written last has to be on the disk.
    due: Option<Instant>,
    progress: Progress,
    buffer: Vec<u8>,
}

/// The segment being written.
#[derive(Default)]
struct Segment {
    /// How many were begun.
    begun: u64,
    /// Its bytes, and how many of them are on the disk.
    bytes: u64,
    synced: u64,
    /// The bytes of its deltas.
    deltas: u64,
}

/// However the thread ends, commits leave nothing for it any more, and nobody waits for it.
impl<S> Drop for Writer<S> {
    fn drop(&mut self) {
        self.feed.end();
        self.feed.restart();
        self.progress.over = true;
        self.feed.report(&self.progress);
    }
}

impl<S: Store> Writer<S> {
    pub(super) fn new(store: S, settings: Settings, feed: Arc<Feed>, graph: Observed) -> Self {
        Self {
            store,
            settings,
            feed,
            graph,
            segment: Segment::default(),
            due: None,
            progress: Progress::default(),
            buffer: Vec::new(),
        }
    }

    /// Writes until the graph or the journal is gone, or the store fails.
    pub(super) fn run(mut self, first: Snapshot) {
        if let Err(error) = self.work(first) {
            self.progress.error = Some(Arc::new(error));
        }
    }

    fn work(&mut self, first: Snapshot) -> io::Result<()> {
        self.begin(&first)?;
        drop(first);
        self.feed.report(&self.progress);
        let mut spare = Vec::new();
        loop {
            let Work { mut deltas, overflowed, wanted, last } = self.feed.take(self.due, spare);
            self.deltas(&deltas)?;
            deltas.clear();
            spare = deltas;
            if let Some(last) = last {
                return self.finish(overflowed, last);
            }
            if overflowed || self.segment.deltas >= self.settings.segment_bytes {
                self.rotate(overflowed)?;
            }
            let urgent = wanted > self.progress.durable;
            if urgent || self.due.is_some_and(|due| due <= Instant::now()) {
                self.sync()?;
            }
            self.feed.report(&self.progress);
        }
    }

    /// Begins a segment with the state of now, after what led there.
    fn rotate(&mut self, overflowed: bool) -> io::Result<()> {
        let Some((rest, state)) = self.graph.restart(&self.feed) else { return Ok(()) };
        if overflowed {
            self.progress.gaps += 1;
        }
        self.deltas(&rest)?;
        self.begin(&state)
    }

    fn finish(&mut self, overflowed: bool, last: Last) -> io::Result<()> {
        let state = last.state.or_else(|| self.graph.restart(&self.feed).map(|(_, state)| state));
        if let Some(state) = state.filter(|_| overflowed) {
            self.progress.gaps += 1;
            self.begin(&state)?;
        }
        self.sync()
    }

    fn begin(&mut self, state: &Snapshot) -> io::Result<()> {
        if self.segment.begun > 0 {
            self.sync()?;
        }
        self.store.begin(self.segment.begun)?;
        self.segment = Segment { begun: self.segment.begun + 1, ..Segment::default() };
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        record::put_start(state.dictionary(), &mut buffer);
        self.frame(Kind::Start, &mut buffer)?;
        record::put_state(state, &mut buffer, |buffer| {
            if buffer.len() >= FRAME { self.frame(Kind::State, buffer) } else { Ok(()) }
        })?;
        self.frame(Kind::State, &mut buffer)?;
        self.buffer = buffer;
        self.progress.written = state.version();
        self.sync()?;
        match self.settings.segments {
            Some(kept) => self.store.forget(self.segment.begun.saturating_sub(kept.get())),
            None => Ok(()),
        }
    }

    fn deltas(&mut self, deltas: &[Arc<Delta>]) -> io::Result<()> {
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        for delta in deltas {
            // A state taken while a delta waited has it already.
            if delta.version <= self.progress.written {
                continue;
            }
            record::put_delta(delta, &mut buffer);
            self.progress.written = delta.version;
            if buffer.len() >= FRAME {
                self.segment.deltas += buffer.len() as u64;
                self.frame(Kind::Deltas, &mut buffer)?;
            }
        }
        if !buffer.is_empty() {
            self.segment.deltas += buffer.len() as u64;
            self.frame(Kind::Deltas, &mut buffer)?;
        }
        self.buffer = buffer;
        if self.due.is_none() && self.progress.durable < self.progress.written {
            self.due = Some(match self.settings.durability {
                Durability::Each => Instant::now(),
                Durability::Every(time) => Instant::now() + time,
            });
        }
        Ok(())
    }

    fn frame(&mut self, kind: Kind, payload: &mut Vec<u8>) -> io::Result<()> {
        let header = frame::header(kind, payload, self.segment.synced);
        self.store.append(&header)?;
        self.store.append(payload)?;
        self.segment.bytes += (header.len() + payload.len()) as u64;
        payload.clear();
        Ok(())
    }

    fn sync(&mut self) -> io::Result<()> {
        self.due = None;
        if self.segment.synced < self.segment.bytes {
            self.store.sync()?;
            self.segment.synced = self.segment.bytes;
        }
        self.progress.durable = self.progress.written;
        Ok(())
    }
}

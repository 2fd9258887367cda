//! The journal's thread: takes the waiting deltas as one group, writes them, syncs when due, and begins segments.

use std::io;
use std::sync::Arc;
use std::time::Instant;

use super::feed::{Entry, Feed, Last, Present, Progress, Work};
use super::frame::{self, Kind};
use super::record::{self, Follows};
use super::settings::{Durability, Settings};
use super::store::Store;
use crate::graph::Observed;

/// Bytes after which a frame of a state is closed, and after which frames are appended.
const FRAME: usize = 1 << 20;

pub(super) struct Writer<S> {
    pub(super) store: S,
    pub(super) settings: Settings,
    pub(super) feed: Arc<Feed>,
    pub(super) graph: Observed,
    segment: Segment,
    /// The time by which the last write must be synced.
    due: Option<Instant>,
    progress: Progress,
    buffer: Vec<u8>,
    /// The most bytes of a record; one of a state has to fit into a frame with those before it.
    longest: usize,
    /// A commit could not be written, so the next record must be a whole state.
    broken: bool,
    /// The thread has ended normally or has reported its error.
    ended: bool,
}

/// The segment being written.
#[derive(Default)]
struct Segment {
    /// The number of segments begun.
    begun: u64,
    /// Its bytes, and the number of them that are synced.
    bytes: u64,
    synced: u64,
    /// The bytes of its deltas.
    deltas: u64,
}

/// When the thread ends, also by a panic of the store, commits stop leaving deltas for it, no caller waits for it any
/// more, and nothing unwritten is reported as written.
impl<S> Drop for Writer<S> {
    fn drop(&mut self) {
        self.feed.end();
        self.feed.restart();
        if !self.ended {
            self.progress.error = Some(Arc::new(io::Error::other("the thread that writes it panicked")));
        }
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
            longest: frame::LONGEST as usize - FRAME,
            broken: false,
            ended: false,
        }
    }

    /// Writes until the graph or the journal is dropped, or the store fails.
    pub(super) fn run(mut self, first: Present) {
        if let Err(error) = self.work(first) {
            self.progress.error = Some(Arc::new(error));
        }
        self.ended = true;
    }

    fn work(&mut self, first: Present) -> io::Result<()> {
        self.begin(&first, Follows::Nothing)?;
        drop(first);
        self.feed.report(&self.progress);
        let mut spare = Vec::new();
        loop {
            let Work { mut entries, overflowed, wanted, last } = self.feed.take(self.due, spare);
            self.commits(&entries)?;
            entries.clear();
            spare = entries;
            if let Some(last) = last {
                return self.finish(overflowed, last);
            }
            if overflowed || self.broken || self.segment.deltas >= self.settings.segment_bytes {
                self.rotate()?;
            }
            let urgent = wanted > self.progress.durable;
            if urgent || self.due.is_some_and(|due| due <= Instant::now()) {
                self.sync()?;
            }
            self.feed.report(&self.progress);
        }
    }

    /// Begins a segment with the present state, after writing the deltas that lead to it.
    fn rotate(&mut self) -> io::Result<()> {
        let Some((rest, state)) = self.graph.restart(&self.feed) else { return Ok(()) };
        self.commits(&rest.entries)?;
        let follows = if rest.overflowed || self.broken { Follows::AfterGap } else { Follows::Directly };
        self.progress.gaps += u64::from(follows == Follows::AfterGap);
        self.begin(&state, follows)
    }

    fn finish(&mut self, overflowed: bool, last: Last) -> io::Result<()> {
        if overflowed || self.broken {
            let state = last.state.or_else(|| self.graph.restart(&self.feed).map(|(_, state)| state));
            self.progress.gaps += 1;
            if let Some(state) = state {
                self.begin(&state, Follows::AfterGap)?;
            }
        }
        self.sync()
    }

    fn begin(&mut self, state: &Present, follows: Follows) -> io::Result<()> {
        self.sync()?;
        self.store.begin(self.segment.begun)?;
        self.broken = false;
        self.segment = Segment { begun: self.segment.begun + 1, ..Segment::default() };
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        frame::open(&mut buffer);
        record::put_start(follows, state.snapshot.vocabulary(), &mut buffer);
        self.frame(Kind::Start, &mut buffer)?;
        record::put_state(state, &mut buffer, |buffer| {
            if buffer.len() >= FRAME { self.frame(Kind::State, buffer) } else { Ok(()) }
        })?;
        self.frame(Kind::State, &mut buffer)?;
        self.buffer = buffer;
        self.progress.written = state.snapshot.version();
        self.sync()?;
        match self.settings.segments {
            Some(kept) => self.store.keep(kept),
            None => Ok(()),
        }
    }

    fn commits(&mut self, entries: &[Entry]) -> io::Result<()> {
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        for entry in entries {
            // A state that was taken while a commit waited already includes it. One that made no version may come twice:
            // it then registers or dismisses what it has before.
            let (version, written) = (entry.delta.version, self.progress.written);
            if version < written || (version == written && !entry.is_silent()) {
                continue;
            }
            let start = frame::open(&mut buffer);
            let kind = record::put_commit(entry, &mut buffer);
            self.broken |= buffer.len() - start - frame::HEADER > self.longest;
            if self.broken {
                buffer.truncate(start);
                break;
            }
            // A frame of its own: damage takes no other commit with it.
            frame::close(&mut buffer, start, kind, self.segment.synced);
            self.progress.written = version;
            if buffer.len() >= FRAME {
                self.append_deltas(&mut buffer)?;
            }
        }
        self.append_deltas(&mut buffer)?;
        self.buffer = buffer;
        if self.due.is_none() && self.segment.synced < self.segment.bytes {
            self.due = match self.settings.durability {
                Durability::Each => Some(Instant::now()),
                // `None` means never: the time is beyond what `Instant` can hold.
                Durability::Every(time) => Instant::now().checked_add(time),
            };
        }
        Ok(())
    }

    fn append_deltas(&mut self, frames: &mut Vec<u8>) -> io::Result<()> {
        self.segment.deltas += frames.len() as u64;
        self.append(frames)?;
        frames.clear();
        Ok(())
    }

    /// Ends and appends the frame that the bytes begin with, and begins another one.
    fn frame(&mut self, kind: Kind, bytes: &mut Vec<u8>) -> io::Result<()> {
        if bytes.len() - frame::HEADER > self.longest + FRAME {
            return Err(io::Error::new(
                io::ErrorKind::FileTooLarge,
                "a node with more than a frame can hold",
            ));
        }
        frame::close(bytes, 0, kind, self.segment.synced);
        self.append(bytes)?;
        bytes.clear();
        frame::open(bytes);
        Ok(())
    }

    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        if !bytes.is_empty() {
            self.store.append(bytes)?;
            self.segment.bytes += bytes.len() as u64;
        }
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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that fails says where")]
mod tests {
    use super::*;
    use crate::graph::Graph;
    use crate::id::{AgentId, Time, Version};
    use crate::journal::{Memory, Recording};
    use crate::vocabulary::{Nature, VocabularyBuilder};

    /// A commit that is too large for a frame is a gap, and later commits are recorded; a node that is too large is an
    /// error.
    #[test]
    fn what_is_too_long_for_a_frame_is_left_out_and_told() {
        let mut builder = VocabularyBuilder::new();
        let thing = builder.node_type("thing", None, Nature::Symbolic).unwrap();
        let graph = Graph::new(builder.build());
        let add = |names: std::ops::Range<u64>| {
            let named = |tx: &mut crate::Transaction| {
                names.clone().for_each(|name| _ = tx.add_node(format!("thing {name}").as_str(), thing));
            };
            graph.edit(AgentId::DSR, Time(0), named).unwrap().version
        };
        let (memory, feed) = (Memory::default(), Arc::new(Feed::new(1 << 30)));
        let settings = Settings { durability: Durability::Each, ..Settings::default() };
        let first = graph.attach(&feed);
        let mut writer = Writer::new(memory.clone(), settings.clone(), Arc::clone(&feed), graph.observed());
        writer.longest = 2_000;
        add(0..3);
        let long = add(3..1_000);
        add(1_000..1_003);
        feed.end();
        writer.run(first);
        let done = feed.progress();
        assert!(done.error.is_none());
        assert_eq!((done.gaps, done.durable), (1, graph.snapshot().version()));
        let recording = Recording::read(memory.segments()).unwrap();
        assert_eq!(recording.at(done.durable).unwrap().export(), graph.snapshot().export());
        assert!(recording.at(long).is_err() && recording.at(Version(long.0 - 1)).is_ok());

        let feed = Arc::new(Feed::new(1 << 30));
        graph
            .edit(AgentId::DSR, Time(0), |tx| _ = tx.add_node("x".repeat(FRAME + 2_001).as_str(), thing))
            .unwrap();
        let first = graph.attach(&feed);
        let mut writer = Writer::new(Memory::default(), settings, Arc::clone(&feed), graph.observed());
        writer.longest = 2_000;
        writer.run(first);
        assert_eq!(feed.progress().error.unwrap().kind(), io::ErrorKind::FileTooLarge);
    }
}

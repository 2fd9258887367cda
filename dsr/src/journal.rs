//! The journal: every commit on disk, off the commit path, and every version back from there.
//!
//! Problem: what a robot knew and did must outlive the process and be looked at afterwards, and no disk may slow the
//! robot. Idea: a commit leaves a reference to its delta in a [`feed`]; one thread takes whatever waits as a group,
//! appends it as one checksummed frame and syncs when the [`Durability`] says so. A journal is a row of segments, each
//! of which begins with the vocabulary and a whole state, so that old ones can be let go of and any can be read alone.
//!
//! Invariants: a journal read back gives each version to the byte, or says which it lacks; a writer waits for no disk,
//! and no more than [`Settings::waiting_bytes`] wait for one; what is torn at the end is told apart from what was
//! damaged later; no bytes make the reader panic.
//!
//! This module is the only one of the crate that knows threads, times and files, and it opens none but those of a
//! [`Folder`] or those that [`Recording::open`] is asked for.

mod error;
pub(crate) mod feed;
mod frame;
mod playback;
mod reader;
mod record;
mod recording;
mod segment;
mod settings;
mod store;
mod writer;

use std::io;
use std::sync::Arc;
use std::thread::JoinHandle;

pub use self::error::{Damage, RecordingError};
use self::feed::Feed;
pub use self::playback::{Played, Replay};
pub use self::recording::Recording;
pub use self::settings::{Durability, Settings};
pub use self::store::{Folder, Memory, Store};
use self::writer::Writer;
use crate::graph::Graph;
use crate::id::Version;

/// How far a journal is.
#[derive(Debug, Clone)]
pub struct Progress {
    /// The newest version in the store.
    pub written: Version,
    /// The newest version that would outlive a loss of power.
    pub durable: Version,
    /// How often commits were left out, because the store was too slow or one was larger than a gibibyte.
    pub gaps: u64,
}

/// The store failed or panicked: what was durable is, and nothing more will be written.
#[derive(Debug, Clone, thiserror::Error)]
#[error("the journal ends at version {}: {error}", durable.0)]
pub struct JournalError {
    /// The newest version that would outlive a loss of power.
    pub durable: Version,
    /// What the store said, or that it panicked.
    pub error: Arc<io::Error>,
}

/// A journal being written. When it is dropped, what was committed before is written and synced.
#[derive(Debug)]
pub struct Journal {
    feed: Arc<Feed>,
    thread: Option<JoinHandle<()>>,
}

impl Journal {
    /// How far it is.
    pub fn progress(&self) -> Result<Progress, JournalError> {
        told(self.feed.progress())
    }

    /// Waits until a version that was committed would outlive a loss of power. Asks for a sync at once.
    pub fn wait(&self, version: Version) -> Result<Progress, JournalError> {
        told(self.feed.wait(version))
    }

    /// Writes what was committed before, syncs it, and ends.
    pub fn close(mut self) -> Result<Progress, JournalError> {
        self.end();
        told(self.feed.progress())
    }

    fn end(&mut self) {
        self.feed.end();
        if let Some(thread) = self.thread.take() {
            // A panic there has been reported by the panic hook; it is no reason for one here.
            let _ = thread.join();
        }
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        self.end();
    }
}

fn told(progress: feed::Progress) -> Result<Progress, JournalError> {
    let feed::Progress { written, durable, gaps, error, .. } = progress;
    match error {
        Some(error) => Err(JournalError { durable, error }),
        None => Ok(Progress { written, durable, gaps }),
    }
}

impl Graph {
    /// Writes the present state and every commit from now on to a store, on a thread of its own.
    pub fn journal(&self, store: impl Store, settings: Settings) -> io::Result<Journal> {
        let feed = Arc::new(Feed::new(settings.waiting_bytes));
        let first = self.attach(&feed);
        let writer = Writer::new(store, settings, Arc::clone(&feed), self.observed());
        let thread = std::thread::Builder::new().name("journal".to_owned());
        match thread.spawn(move || writer.run(first)) {
            Ok(thread) => Ok(Journal { feed, thread: Some(thread) }),
            Err(error) => {
                feed.end();
                Err(error)
            }
        }
    }
}

//! The journal: every commit on disk, off the commit path; and every version back from there.
//!
//! Problem: what a robot knew and did must outlive the process, for later inspection, and no disk may slow the robot.
//! Idea: a commit leaves a reference to its delta in a [`feed`]. One thread takes all waiting deltas as a group,
//! appends them, each as a checksummed frame, and syncs when the [`Durability`] requires it. A journal is a sequence of
//! segments. Each begins with the vocabulary and a whole state, so old ones can be deleted and any one can be read
//! alone.
//!
//! Invariants: a journal that is read back gives each version to the byte, or reports which ones are missing. A writer
//! waits for no disk, and at most [`Settings::waiting_bytes`] wait for one. Only what an interrupted append leaves is a
//! torn end; anything else is damage, and nothing is ever cut from a file. No bytes make the reader panic.
//!
//! This module is the only one of the crate that uses threads, clocks and files. It opens only the files of a
//! [`Folder`] and those that [`Recording::open`] is given.

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

/// The progress of a journal.
#[derive(Debug, Clone)]
pub struct Progress {
    /// The newest version in the store.
    pub written: Version,
    /// The newest version that is synced, and so survives a loss of power.
    pub durable: Version,
    /// The number of gaps: times when commits were left out, because the store was too slow or a commit was larger than
    /// a gibibyte.
    pub gaps: u64,
}

/// The store failed or panicked: what was durable stays so, and nothing more will be written.
#[derive(Debug, Clone, thiserror::Error)]
#[error("the journal ends at version {}: {error}", durable.0)]
pub struct JournalError {
    /// The newest version that is synced, and so survives a loss of power.
    pub durable: Version,
    /// The error of the store, or that it panicked.
    pub error: Arc<io::Error>,
}

/// A journal being written. Dropping it writes and syncs what was committed before.
#[derive(Debug)]
pub struct Journal {
    feed: Arc<Feed>,
    thread: Option<JoinHandle<()>>,
}

impl Journal {
    /// The progress so far.
    pub fn progress(&self) -> Result<Progress, JournalError> {
        told(self.feed.progress())
    }

    /// Waits until a committed version is synced, which it requests at once.
    pub fn wait(&self, version: Version) -> Result<Progress, JournalError> {
        told(self.feed.wait(version))
    }

    /// [`Journal::wait`] for other threads, and after the end of the journal: then it no longer waits.
    pub fn waiter(&self) -> impl Fn(Version) + Send + Sync + use<> {
        let feed = Arc::clone(&self.feed);
        move |version| _ = feed.wait(version)
    }

    /// Writes and syncs what was committed before, and ends the journal.
    pub fn close(mut self) -> Result<Progress, JournalError> {
        self.end();
        told(self.feed.progress())
    }

    fn end(&mut self) {
        self.feed.end();
        if let Some(thread) = self.thread.take() {
            // The panic hook has reported a panic of the thread; it must not cause another one here.
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

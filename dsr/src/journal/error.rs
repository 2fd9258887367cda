//! Faults of a journal that is read.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use crate::id::{Time, Version};
use crate::replay::ReplayError;

/// Why a recording, or a version of it, cannot be read.
#[derive(Debug, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum RecordingError {
    /// A file or a folder that cannot be read.
    #[error("cannot read `{}`: {error}", path.display())]
    Unreadable { path: PathBuf, error: io::Error },
    /// There is no segment.
    #[error("no state of a journal")]
    Empty,
    /// No segment has a readable state; `damage` is the most likely cause.
    #[error("{damage}; there is no state that can be read")]
    Damaged { damage: Damage },
    /// The journal has no such version.
    #[error("no version {}: there are versions {} to {}", asked.0, first.0, last.0)]
    NoVersion { asked: Version, first: Version, last: Version },
    /// The journal has earlier and later versions, but not this one.
    #[error("version {} was not recorded: version {} follows on {}", asked.0, next.0, before.0)]
    NotRecorded { asked: Version, before: Version, next: Version },
    /// All versions were committed after that time.
    #[error("nothing was recorded at {} ns or before: the earliest state is of {} ns", asked.0, earliest.0)]
    NoTime { asked: Time, earliest: Time },
    /// Bytes with a valid checksum that do not continue what precedes them.
    #[error("`{segment}`, byte {offset}: {error}")]
    Misfit { segment: Arc<str>, offset: usize, error: ReplayError },
    /// A file has changed since the recording was opened.
    #[error("`{segment}` changed while it was read")]
    Changed { segment: Arc<str> },
}

/// A fault of a segment, or why it is left out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[expect(missing_docs, reason = "the fields are what the variant is about")]
pub enum Damage {
    /// An append that was interrupted when the process or the machine stopped. It was never durable, and nothing intact
    /// follows it. The bytes stay in the file.
    #[error("`{segment}` ends in a torn record at byte {offset}: {bytes} bytes are left out")]
    Torn { segment: Arc<str>, offset: usize, bytes: usize },
    /// Bytes that were written have changed, or were synced and are missing.
    #[error("`{segment}` is corrupt at byte {offset}; the {bytes} bytes from there on cannot be read")]
    Corrupt { segment: Arc<str>, offset: usize, bytes: usize },
    /// What was synced behind the last byte is missing.
    #[error("`{segment}` ends too early, at byte {offset}")]
    Short { segment: Arc<str>, offset: usize },
    /// Versions are missing that the journal had written: the end of the segment, or a segment behind it.
    #[error("`{segment}` ends at byte {offset} with version {}, the segments behind it begin at {}: what was \
        recorded in between is missing", last.0, next.0)]
    Missing { segment: Arc<str>, offset: usize, last: Version, next: Version },
    /// It has the name of a segment, and no byte of one.
    #[error("`{segment}` is no segment of a journal")]
    Foreign { segment: Arc<str> },
    /// The process or the machine stopped while the segment was begun, or it is being begun at this moment.
    #[error("`{segment}` ends before its state does: there is nothing to read in it")]
    Unfinished { segment: Arc<str> },
    /// It has another vocabulary than the newest segment.
    #[error("`{segment}` has another vocabulary than the segments behind it and is left out")]
    OtherVocabulary { segment: Arc<str> },
    /// The segments after it do not continue from its end.
    #[error("`{segment}` goes to version {}, the segments behind it begin at {}: it is of another history \
        and left out", last.0, next.0)]
    OtherHistory { segment: Arc<str>, last: Version, next: Version },
    /// It has a format that this program does not know.
    #[error("`{segment}` has format {format}, which this program does not know")]
    Format { segment: Arc<str>, format: u32 },
    /// The system cannot read the file.
    #[error("cannot read `{segment}`: {error}")]
    Unreadable { segment: Arc<str>, error: io::ErrorKind },
}

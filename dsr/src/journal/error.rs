//! What can be wrong with a journal that is read.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use crate::id::{Time, Version};
use crate::replay::ReplayError;

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

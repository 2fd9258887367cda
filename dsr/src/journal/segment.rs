//! One segment of a recording: where its bytes are, and its frames.

use std::borrow::Cow;
use std::path::PathBuf;
use std::sync::Arc;

use super::error::{Damage, RecordingError};
use super::frame::Frame;
use super::record::Follows;
use crate::id::{Time, Version};
use crate::vocabulary::Vocabulary;

/// Where the bytes of a segment are.
#[derive(Debug)]
pub(super) enum Source {
    Bytes(Vec<u8>),
    File(PathBuf),
}

/// A segment whose state, at least, can be read.
#[derive(Debug)]
pub(super) struct Segment {
    pub(super) name: Arc<str>,
    pub(super) source: Source,
    pub(super) vocabulary: Arc<Vocabulary>,
    pub(super) follows: Follows,
    pub(super) frames: Vec<Frame>,
    /// For each frame, the earliest time of a version in it; `None` for the first frame.
    pub(super) earliest: Vec<Option<Time>>,
    /// Version and time of its state.
    pub(super) first: (Version, Time),
    /// Version and time of its last delta.
    pub(super) last: (Version, Time),
    /// What is wrong behind that.
    pub(super) fault: Option<Damage>,
}

impl Segment {
    /// The journal that wrote it also wrote the segment before it.
    pub(super) fn goes_on(&self) -> bool {
        self.follows != Follows::Nothing
    }

    pub(super) fn bytes(&self) -> Result<Cow<'_, [u8]>, RecordingError> {
        match &self.source {
            Source::Bytes(bytes) => Ok(bytes.into()),
            Source::File(path) => match std::fs::read(path) {
                Ok(bytes) => Ok(bytes.into()),
                Err(error) => Err(RecordingError::Unreadable { path: path.clone(), error }),
            },
        }
    }
}

//! Journals on disk: reads them, creates them, and returns their states.

use super::failed::{Failed, unwritable};
use crate::console::Console;
use crate::exit::Exit;
use crate::render;
use dsr::{Damage, Folder, Graph, Journal, Recording, RecordingError, Settings, Snapshot, Time, Version};
use std::path::Path;
use std::str::FromStr;

/// A moment of a run: `12` is a version, `3.5s` a time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Moment {
    Version(Version),
    Time(Time),
}

impl FromStr for Moment {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let wrong = || "a version such as `12`, or a time such as `3.5s`".to_owned();
        let Some(seconds) = text.strip_suffix('s') else {
            return text.parse().map(|version| Self::Version(Version(version))).map_err(|_| wrong());
        };
        let seconds: f64 = seconds.parse().map_err(|_| wrong())?;
        let time = std::time::Duration::try_from_secs_f64(seconds).map_err(|_| wrong())?;
        Ok(Self::Time(Time(u64::try_from(time.as_nanos()).map_err(|_| wrong())?)))
    }
}

impl Moment {
    /// The state at this moment.
    pub(crate) fn of(self, recording: &Recording) -> Result<Snapshot, RecordingError> {
        match self {
            Self::Version(version) => recording.at(version),
            Self::Time(time) => recording.at_time(time),
        }
    }
}

/// The state at a moment; without a moment, the last state.
pub(super) fn state(recording: &Recording, at: Option<Moment>) -> Result<Snapshot, RecordingError> {
    at.unwrap_or(Moment::Version(recording.last().0)).of(recording)
}

/// Reads a journal and reports its unreadable parts.
pub(crate) fn open(path: &Path, console: &mut Console<'_>) -> Result<(Recording, Exit), Failed> {
    let recording = match Recording::open(path) {
        Err(RecordingError::Empty) => {
            let message = format!("cannot read `{}`: it holds no state of a journal", path.display());
            return Err(Failed(Exit::Unreadable, message));
        }
        recording => recording?,
    };
    let mut exit = Exit::Yes;
    for damage in recording.damage() {
        match damage {
            Damage::Torn { .. }
            | Damage::Unfinished { .. }
            | Damage::OtherVocabulary { .. }
            | Damage::OtherHistory { .. } => console.note(&format!("note: {damage}")),
            Damage::Corrupt { .. }
            | Damage::Short { .. }
            | Damage::Missing { .. }
            | Damage::Foreign { .. }
            | Damage::Format { .. }
            | Damage::Unreadable { .. } => {
                render::error(damage.to_string(), console);
                exit = Exit::Unreadable;
            }
        }
    }
    Ok((recording, exit))
}

/// Creates a journal of `graph` in a folder without one.
///
/// # Errors
/// Always [`Exit::Unwritable`]: the folder already has a journal, or is not writable.
pub(crate) fn begin(folder: &Path, graph: &Graph) -> Result<Journal, Failed> {
    let store = Folder::new(folder).map_err(|error| unwritable(folder, &error))?;
    if !store.is_fresh() {
        return Err(unwritable(folder, &"there is one already"));
    }
    graph.journal(store, Settings::default()).map_err(|error| unwritable(folder, &error))
}

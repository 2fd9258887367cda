//! `pelea dsr`: looking at the graph of a run, afterwards and at any version.
//!
//! What is read is a journal: the folder that `pelea run --journal` wrote, or one file of it. A torn end is noted and cut;
//! damage is an error with its byte, and what can be read is shown all the same. As JSON, `show` is one line of the kind
//! `graph` (the export), `log` and `diff` a line of the kind `commit` or `difference` each, `query` a line of the kind
//! `match` each.

mod export;
mod history;
mod show;
mod world;

use crate::console::Console;
use crate::exit::Exit;
use crate::render;
use clap::Subcommand;
use dsr::{Damage, Folder, Graph, Journal, Recording, RecordingError, Settings, Snapshot, Time, Version};
use std::path::Path;
use std::str::FromStr;

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// A state: as sentences, for graphviz, as a picture or as data.
    Show(show::Arguments),
    /// Every commit: version, time, writer, and what changed.
    Log(history::LogArguments),
    /// What differs between two versions.
    Diff(history::DiffArguments),
    /// Where a pattern matches.
    Query(history::QueryArguments),
    /// The whole history for Foxglove and other tools that read MCAP.
    Export(export::Arguments),
    /// Take over a world of RoboComp's cortex.
    Import(world::Arguments),
}

pub(crate) fn run(command: &Command, console: &mut Console<'_>) -> Exit {
    let done = match command {
        Command::Show(arguments) => show::run(arguments, console),
        Command::Log(arguments) => history::log(arguments, console),
        Command::Diff(arguments) => history::diff(arguments, console),
        Command::Query(arguments) => history::query(arguments, console),
        Command::Export(arguments) => export::run(arguments, console),
        Command::Import(arguments) => world::run(arguments, console),
    };
    done.unwrap_or_else(|failed| failed.show(console))
}

/// Why a command has no result.
#[derive(Debug)]
pub(crate) struct Failed(Exit, String);

impl Failed {
    pub(crate) fn show(self, console: &mut Console<'_>) -> Exit {
        render::error(self.1, console);
        self.0
    }
}

impl From<RecordingError> for Failed {
    fn from(error: RecordingError) -> Self {
        Self(Exit::Unreadable, error.to_string())
    }
}

/// A moment of a run: `12` is a version, `3.5s` a time.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Moment {
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
    fn of(self, recording: &Recording) -> Result<Snapshot, RecordingError> {
        match self {
            Self::Version(version) => recording.at(version),
            Self::Time(time) => recording.at_time(time),
        }
    }
}

/// The state at a moment, the last one if none is named.
fn state(recording: &Recording, at: Option<Moment>) -> Result<Snapshot, RecordingError> {
    at.unwrap_or(Moment::Version(recording.last().0)).of(recording)
}

/// Reads a journal and says what of it cannot be read.
fn open(path: &Path, console: &mut Console<'_>) -> Result<(Recording, Exit), Failed> {
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
            Damage::Corrupt { .. } | Damage::Format { .. } | Damage::Unreadable { .. } => {
                render::error(damage.to_string(), console);
                exit = Exit::Unreadable;
            }
        }
    }
    Ok((recording, exit))
}

/// Begins a journal of `graph` in a folder that holds none. A folder that cannot take it is a result that cannot be
/// written, whatever the reason.
pub(crate) fn begin(folder: &Path, graph: &Graph) -> Result<Journal, Failed> {
    let store = Folder::new(folder).map_err(|error| unwritable(folder, &error))?;
    if !store.is_fresh() {
        return Err(unwritable(folder, &"there is one already"));
    }
    graph.journal(store, Settings::default()).map_err(|error| unwritable(folder, &error))
}

fn unwritable_file(path: &Path, why: &dyn std::fmt::Display) -> Failed {
    Failed(Exit::Unwritable, format!("cannot write `{}`: {why}", path.display()))
}

fn unwritable(folder: &Path, why: &dyn std::fmt::Display) -> Failed {
    Failed(Exit::Unwritable, format!("cannot write a journal to `{}`: {why}", folder.display()))
}

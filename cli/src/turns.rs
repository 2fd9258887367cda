//! The file of PELEA's turns, beside a journal: written by `run`, read by `replay`.
//!
//! A line each: first the run's own settings and the checksum of every text of the mission, then the turns with their
//! numbers, and at the end of an orderly run how many there were. A turn that is missing is noticed.

use crate::outlet::Outlet;
use executive::{Occurrence, Turn};
use mission::Mission;
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::time::Duration;

/// The file's name in the folder of a journal.
const NAME: &str = "turns.jsonl";

/// What a replay needs to know about a run.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct Heading {
    /// The checksum of each text, by the name of its file.
    pub(crate) texts: BTreeMap<String, u32>,
    /// The end of the run whatever happens, in nanoseconds.
    pub(crate) horizon: Option<Duration>,
    /// How often PELEA turns at least.
    pub(crate) pulse: Option<Duration>,
}

impl Heading {
    /// The settings of a run of this mission.
    pub(crate) fn new(mission: &Mission, horizon: Option<Duration>, pulse: Option<Duration>) -> Self {
        let manifest = mission
            .sources
            .iter()
            .map(|(_, source)| source.name())
            .find_map(|name| name.strip_suffix("mission.toml"));
        let folder = manifest.unwrap_or_default();
        let text = |source: &diagnostics::Source| (file_name(source.name(), folder), checksum(source.text()));
        Self { texts: mission.sources.iter().map(|(_, source)| text(source)).collect(), horizon, pulse }
    }

    /// The texts that are not those of the other run.
    pub(crate) fn changed(&self, other: &Self) -> Vec<String> {
        let differs = |name: &&String| self.texts.get(*name) != other.texts.get(*name);
        let mut names: Vec<_> =
            self.texts.keys().chain(other.texts.keys()).filter(differs).cloned().collect();
        names.sort_unstable();
        names.dedup();
        names
    }
}

/// A path in the mission's folder, or the last two parts of another one, which tell `agents/speech.pddl` from another
/// `speech.pddl`: the same wherever the mission stands.
fn file_name(path: &str, folder: &str) -> String {
    if let Some(inside) = path.strip_prefix(folder).filter(|inside| !inside.starts_with("..")) {
        return inside.to_owned();
    }
    let parts: Vec<_> = path.rsplit('/').take(2).collect();
    parts.into_iter().rev().collect::<Vec<_>>().join("/")
}

fn checksum(text: &str) -> u32 {
    crc32fast::hash(text.as_bytes())
}

/// The writing end.
pub(crate) struct Turns {
    out: Outlet,
    count: u64,
}

impl Turns {
    /// Begins the file in the folder of a journal.
    pub(crate) fn begin(folder: &Path, heading: &Heading) -> io::Result<Self> {
        let file = File::create(folder.join(NAME))?;
        let mut turns = Self { out: Outlet::new(file, |lost| format!(r#"{{"lost":{lost}}}"#)), count: 0 };
        turns.line(heading);
        Ok(turns)
    }

    /// Adds a turn.
    pub(crate) fn note(&mut self, turn: &Turn<'_>) {
        #[derive(Serialize)]
        struct Line<'a> {
            turn: u64,
            now: u64,
            event: &'a Occurrence,
            effects: &'a [executive::Effect],
        }
        self.count += 1;
        self.line(&Line { turn: self.count, now: turn.now, event: &turn.event, effects: turn.effects });
    }

    fn line(&mut self, line: &impl Serialize) {
        if let Ok(text) = serde_json::to_string(line) {
            // An outlet takes every line; a disk that fails is the journal's to report.
            let _ = writeln!(self.out, "{text}");
        }
    }
}

impl Drop for Turns {
    fn drop(&mut self) {
        let count = self.count;
        self.line(&End { end: count });
    }
}

/// The last line of a whole record.
#[derive(Serialize, Deserialize)]
struct End {
    /// How many turns there were.
    end: u64,
}

/// A turn as it was recorded.
#[derive(Debug, Deserialize)]
pub(crate) struct Recorded {
    turn: u64,
    pub(crate) now: u64,
    pub(crate) event: Occurrence,
    /// The effects, as they were written.
    pub(crate) effects: Box<RawValue>,
}

/// Why the file cannot be read.
#[derive(Debug, thiserror::Error)]
pub(crate) enum TurnsError {
    #[error("cannot read `{NAME}` of the journal: {0}")]
    Io(#[from] io::Error),
    #[error("line {line} of `{NAME}` is no turn: {error}")]
    Line { line: usize, error: serde_json::Error },
    #[error("turns of the run are missing in `{NAME}` after turn {after}")]
    Gap { after: u64 },
    #[error("`{NAME}` is empty")]
    Empty,
}

/// The record of a run.
#[derive(Debug)]
pub(crate) struct Record {
    pub(crate) heading: Heading,
    pub(crate) turns: Vec<Recorded>,
    /// Whether it has its end: the run was not cut off.
    pub(crate) whole: bool,
}

/// Reads the file, up to a last line that a crash has cut short.
pub(crate) fn read(folder: &Path) -> Result<Record, TurnsError> {
    let file = BufReader::new(File::open(folder.join(NAME))?);
    let lines = file.lines().collect::<Result<Vec<_>, _>>()?;
    let (heading, rest) = lines.split_first().ok_or(TurnsError::Empty)?;
    let heading = serde_json::from_str(heading).map_err(|error| TurnsError::Line { line: 1, error })?;
    let mut turns: Vec<Recorded> = Vec::with_capacity(rest.len());
    for (at, line) in rest.iter().enumerate() {
        let after = turns.len() as u64;
        if let Ok(End { end }) = serde_json::from_str(line) {
            let whole = end == after;
            return if whole { Ok(Record { heading, turns, whole }) } else { Err(TurnsError::Gap { after }) };
        }
        match serde_json::from_str::<Recorded>(line) {
            Ok(turn) if turn.turn == after + 1 => turns.push(turn),
            Ok(_) => return Err(TurnsError::Gap { after }),
            Err(_) if line.starts_with("{\"lost\":") => return Err(TurnsError::Gap { after }),
            Err(error) if error.is_eof() && at + 1 == rest.len() => break,
            Err(error) => return Err(TurnsError::Line { line: at + 2, error }),
        }
    }
    Ok(Record { heading, turns, whole: false })
}

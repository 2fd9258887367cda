//! The file of PELEA's turns, beside a journal: written by `run`, read by `replay`.
//!
//! A line each: first the run's own settings and the checksum of every text of the mission, then the turns with their
//! numbers, and at the end of an orderly run how many there were. A turn that is missing is noticed. A run that goes on
//! after a restart adds another such part, a *life*. What the life before had turned on versions that the crash took from
//! the journal never happened, and is left out.

use crate::outlet::Outlet;
use dsr::Version;
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
    /// The name of the run, the same in all its lives.
    #[serde(default)]
    pub(crate) run: String,
    /// The version from which it went on after a restart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) from: Option<u64>,
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
        let texts = mission.sources.iter().map(|(_, source)| text(source)).collect();
        Self { texts, horizon, pulse, run: String::new(), from: None }
    }

    /// For a run of this name.
    pub(crate) fn of(self, run: String) -> Self {
        Self { run, ..self }
    }

    /// For a run that goes on from a version.
    pub(crate) fn from(self, version: Version) -> Self {
        Self { from: Some(version.0), ..self }
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

    /// Goes on with the file of an earlier life.
    pub(crate) fn go_on(folder: &Path, heading: &Heading) -> io::Result<Self> {
        let path = folder.join(NAME);
        let torn = std::fs::read(&path)?.last().is_some_and(|last| *last != b'\n');
        let mut file = File::options().append(true).open(path)?;
        if torn {
            file.write_all(b"\n")?;
        }
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

/// One life of a run: from its start, or from a restart, to its end or to a crash.
#[derive(Debug)]
pub(crate) struct Life {
    pub(crate) heading: Heading,
    pub(crate) turns: Vec<Recorded>,
    /// Whether it has its end: the run was not cut off.
    pub(crate) whole: bool,
}

impl Life {
    fn new(heading: Heading) -> Self {
        Self { heading, turns: Vec::new(), whole: false }
    }

    /// Leaves out what it turned on versions behind the last one that outlived it. How many turns these were.
    pub(crate) fn end_at(&mut self, last: Version) -> usize {
        let beyond = |turn: &Recorded| turn.event.version().is_some_and(|version| version > last);
        let kept = self.turns.iter().position(beyond).unwrap_or(self.turns.len());
        self.turns.drain(kept..).count()
    }
}

/// Reads the file: the lives of the run, up to a last line that a crash has cut short.
pub(crate) fn read(folder: &Path) -> Result<Vec<Life>, TurnsError> {
    let file = BufReader::new(File::open(folder.join(NAME))?);
    let lines = file.lines().collect::<Result<Vec<_>, _>>()?;
    let mut lives: Vec<Life> = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let heading = serde_json::from_str::<Heading>(line);
        match (lives.last_mut(), heading) {
            (before, Ok(heading)) => {
                if let (Some(life), Some(from)) = (before, heading.from) {
                    life.end_at(Version(from));
                }
                lives.push(Life::new(heading));
            }
            (None, Err(error)) => return Err(TurnsError::Line { line: 1, error }),
            (Some(life), Err(_)) => {
                // The end of a life is the end of the file, or stands before the heading of the next.
                let is_last =
                    lines.get(at + 1).is_none_or(|next| serde_json::from_str::<Heading>(next).is_ok());
                life.take(line, at + 1, is_last)?;
            }
        }
    }
    if lives.is_empty() { Err(TurnsError::Empty) } else { Ok(lives) }
}

impl Life {
    /// Takes in a line after its heading.
    fn take(&mut self, line: &str, number: usize, is_last: bool) -> Result<(), TurnsError> {
        let after = self.turns.len() as u64;
        if let Ok(End { end }) = serde_json::from_str(line) {
            self.whole = end == after;
            return if self.whole { Ok(()) } else { Err(TurnsError::Gap { after }) };
        }
        match serde_json::from_str::<Recorded>(line) {
            Ok(turn) if turn.turn == after + 1 => self.turns.push(turn),
            Ok(_) => return Err(TurnsError::Gap { after }),
            Err(_) if line.starts_with("{\"lost\":") => return Err(TurnsError::Gap { after }),
            Err(error) if error.is_eof() && is_last => {}
            Err(error) => return Err(TurnsError::Line { line: number, error }),
        }
        Ok(())
    }
}
